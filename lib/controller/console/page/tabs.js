// Tabs of the layouts that show one panel at a time (layout.js). On a phone, and where all is on the picture, pressing the
// selected tab closes its panel, so that the picture gets its place. The map takes the place of the panel.

import { hasTabs } from './layout.js';

const ROOM_FOR_PANEL_PX = 700;  // height of the window from which a phone starts with a panel beside the picture

export class Tabs {
  #tabs = [...document.querySelectorAll('[role="tab"]')];
  #selected = null;
  #layout = '';
  #isMapOn = false;

  // `onShow` is called after a change, `onSelect` when the user selects a panel
  constructor(onShow, onSelect) {
    this.onShow = onShow;
    this.onSelect = onSelect;
    for (const tab of this.#tabs) {
      tab.addEventListener('click', () => this.#press(tab));
      tab.addEventListener('keydown', (event) => {
        const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (!by) return;
        const usable = this.#tabs.filter((other) => other.offsetParent);
        const next = usable[(usable.indexOf(tab) + by + usable.length) % usable.length];
        next.focus();
        this.#select(next);
      });
    }
  }

  setLayout(layout) {
    this.#layout = layout;
    const hasRoom = layout === 'side' || (layout === 'phone' && innerHeight >= ROOM_FOR_PANEL_PX);
    this.#show(hasRoom ? this.#selected ?? this.#first() : null);
  }
  // Another robot: its ranges may have taken the place of the picture, or returned from there.
  refresh() {
    this.#show(this.#selected);
  }
  setMap(isOn) {
    this.#isMapOn = isOn;
    this.#show(this.#selected);
  }

  #first() {
    return this.#tabs.find((tab) => getComputedStyle(tab).display !== 'none') ?? this.#tabs[0];
  }
  #press(tab) {
    const closes = tab === this.#selected && !this.#isMapOn && this.#layout !== 'side';
    this.#select(closes ? null : tab);
  }
  #select(tab) {
    this.#selected = tab;
    if (tab) this.onSelect();
    this.#show(tab);
  }

  #show(tab) {
    // The panel of a tab that this layout does not have is visible anyway.
    const isAbsent = hasTabs(this.#layout) && tab && getComputedStyle(tab).display === 'none';
    this.#selected = isAbsent ? (this.#layout === 'side' ? this.#first() : null) : tab;
    const shown = this.#isMapOn ? null : this.#selected;
    for (const each of this.#tabs) {
      each.setAttribute('aria-selected', String(each === shown));
      each.tabIndex = each === (shown ?? this.#first()) ? 0 : -1;
      document.getElementById(each.getAttribute('aria-controls')).classList.toggle('shown', each === shown);
    }
    document.body.classList.toggle('has-panel', Boolean(shown) || this.#isMapOn);
    document.body.classList.toggle('has-map', this.#isMapOn);
    this.onShow();
  }
}
