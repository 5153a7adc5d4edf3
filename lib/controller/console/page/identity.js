// Name and token of the user, in the browser's storage, and the dialogs in which they are entered.

const $ = (id) => document.getElementById(id);

// The token is in the fragment of the address, which browsers do not send; it is removed so that it cannot be read there.
export function takeTokenFromAddress() {
  const token = new URLSearchParams(location.hash.slice(1)).get('token');
  if (!token) return;
  sessionStorage.setItem('token', token);
  history.replaceState(null, '', location.pathname);
}

// What the page's hello contains.
export function identity() {
  const token = sessionStorage.getItem('token');
  return { name: localStorage.getItem('name') ?? '', ...(token ? { token } : {}) };
}

// Returns a function that opens the help, which contains the name.
export function makeDialogs(link) {
  link.addEventListener('refused', ({ detail }) => {
    sessionStorage.removeItem('token');
    $('login-why').textContent = detail.text;
    $('login').showModal();
  });
  $('login-form').addEventListener('submit', () => {
    sessionStorage.setItem('token', $('token').value);
    $('token').value = '';
    link.connect();
  });
  $('help').addEventListener('close', () => {
    const name = $('name').value.trim();
    if (name === (localStorage.getItem('name') ?? '')) return;
    localStorage.setItem('name', name);
    link.send('hello', { protocol: 1, ...link.hello() });
  });
  const openHelp = () => {
    $('name').value = localStorage.getItem('name') ?? '';
    $('help').showModal();
  };
  $('help-open').addEventListener('click', openHelp);
  return openHelp;
}
