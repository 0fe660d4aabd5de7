'use strict';
// What all pages share: their data, elements, and the colours of theme.css.

const pb = {};

pb.json = (id) => JSON.parse(document.getElementById(id).textContent);

pb.element = (tag, properties, ...children) => {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
};

// Calls `draw` whenever the browser's wish for light or dark changes, or its width between phone and desk.
pb.onLookChange = (draw) => {
  for (const query of ['(prefers-color-scheme: dark)', '(max-width: 640px)']) matchMedia(query).addEventListener('change', draw);
};

// The colour of this name in theme.css.
pb.themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

// [red, green, blue] of "#rrggbb".
pb.channels = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

// Relative luminance and contrast as WCAG 2.1 defines them.
pb.luminance = (hex) => {
  const [r, g, b] = pb.channels(hex).map((c) => c / 255 <= 0.03928 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
pb.contrast = (a, b) => {
  const [low, high] = [pb.luminance(a), pb.luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
};

pb.mix = (a, b, share) => {
  const [from, to] = [pb.channels(a), pb.channels(b)];
  return '#' + from.map((c, k) => Math.round(c + share * (to[k] - c)).toString(16).padStart(2, '0')).join('');
};

// The colour, moved towards that of the text until a line of it can be seen on a card: 3 to 1, as WCAG 1.4.11 asks.
pb.visible = (hex) => {
  if (!/^#[0-9a-f]{6}$/i.test(hex)) return hex;
  const card = pb.themeColour('card'), ink = pb.themeColour('ink');
  let seen = hex;
  for (let share = 0.05; pb.contrast(seen, card) < 3.05 && share <= 1; share += 0.05) seen = pb.mix(hex, ink, share);
  return seen;
};

// A line "name: text" for each entry.
pb.definitionTable = (entries) => pb.element('table', {}, pb.element('tbody', {}, ...entries.map(([name, text]) =>
    pb.element('tr', {}, pb.element('th', {scope: 'row'}, name),
               pb.element('td', {}, text.includes('\n') ? pb.element('pre', {tabIndex: 0}, text) : text)))));

// In the foot of the page: which program and which files it was made from.
pb.showProvenance = () => {
  const {line, entries} = pb.json('provenance-data');
  const place = document.getElementById('provenance');
  place.append(pb.element('p', {}, line));
  if (entries.length === 0) return;
  place.append(pb.element('details', {}, pb.element('summary', {}, 'Settings and provenance'),
      pb.scrollable(pb.element('div', {className: 'tables'}, pb.definitionTable(entries)), 'Settings and provenance')));
};

// A table that is wider than its place is scrolled by the keyboard, too, once it has the focus.
pb.scrollable = (node, label) => {
  node.tabIndex = 0;
  node.setAttribute('role', 'region');
  node.setAttribute('aria-label', label);
  return node;
};
