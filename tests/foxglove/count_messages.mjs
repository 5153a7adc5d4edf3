// Counts the messages of topics that a server of Foxglove's protocol sends, for measurements:
//   node count_messages.mjs ws://127.0.0.1:8765 SECONDS ENDING_OF_TOPICS
// They are not decoded.
import protocol from '@foxglove/ws-protocol';
import WebSocket from 'ws';

const [url, seconds, ending] = process.argv.slice(2);
const client = new protocol.FoxgloveClient({ ws: new WebSocket(url, ['foxglove.sdk.v1', 'foxglove.websocket.v1']) });
let messages = 0, bytes = 0;
client.on('advertise', (channels) => channels.filter(({ topic }) => topic.endsWith(ending)).forEach(({ id }) => client.subscribe(id)));
client.on('message', ({ data }) => { ++messages; bytes += data.byteLength; });
client.on('close', () => process.exit(0));
process.on('exit', () => console.log(`${messages} messages, ${bytes} bytes`));
setTimeout(() => process.exit(0), 1000 * seconds);
