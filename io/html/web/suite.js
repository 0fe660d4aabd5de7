'use strict';
// The page of all scenes.

const scenes = pb.json('suite-data');

const kinds = [
  {key: 'serial', label: 'serial', colour: '#7a8490'},
  {key: 'islands_parallel', label: 'islands parallel', colour: '#0072b2'},
  {key: 'spaces_parallel', label: 'islands and spaces parallel', colour: '#e69f00'},
];

const level = (hz, colour) => ({from: hz, to: hz, label: `line at ${hz} Hz`, colour, dash: [6, 4], showValue: false});

const chart = (id, label, value, y, bands) => pb.draw(document.getElementById(id), label, () => ({
  type: 'bar',
  data: {
    labels: scenes.map((scene) => scene.name),
    datasets: kinds.map((kind) => ({label: kind.label, data: scenes.map((scene) => value(scene.cores[kind.key])), backgroundColor: kind.colour})),
  },
  options: {plugins: {pbmpi: {bands}}, scales: {x: {grid: {display: false}}, y: {...y}}},
}), pb.readByKeyboard);

chart('rates', 'Frame rate of each scene', (rate) => rate.harmonic_mean_hz,
      {type: 'logarithmic', title: {display: true, text: 'Hz'}}, [level(30, '#d55e00'), level(300, '#009e73')]);
chart('satisfied', 'Share of satisfied frames of each scene', (rate) => 100 * rate.satisfied_fraction,
      {min: 0, max: 100, title: {display: true, text: '%'}}, []);

const row = (cells, tag, className = '') => pb.element('tr', {className}, ...cells.map((cell) =>
    pb.element(tag, tag === 'th' ? {scope: 'col'} : {}, String(cell))));
const number = (value, digits) => value === null ? '\u2013' : value.toFixed(digits);
const difference = (value) => value === null ? '\u2013' : `${value >= 0 ? '+' : '\u2212'}${Math.abs(100 * value).toFixed(0)} %`;
const percent = (value) => `${(100 * value).toFixed(0)} %`;

const islands = document.getElementById('islands');
islands.append(row(['scene', '', 'max', 'min', 'mean', 'deviation', 'spaces', 'contacts across spaces'], 'th'));
for (const {name, islands: ours} of scenes) {
  const n = ours.islands;
  islands.append(row([name, 'here', number(n.max, 0), number(n.min, 0), number(n.mean, 1), number(n.stddev, 2), ours.spaces,
                      number(ours.cross_space_contacts_per_step, 1)], 'td'));
  if (ours.paper === null) continue;
  const p = ours.paper, d = ours.relative_difference;
  islands.append(row(['', 'paper', p.max, p.min, p.mean, p.stddev, p.spaces, p.traffic], 'td', 'paper'));
  islands.append(row(['', 'difference', difference(d.max), difference(d.min), difference(d.mean), difference(d.stddev), '', ''],
                     'td', 'paper'));
}

const cores = document.getElementById('cores');
cores.append(row(['scene', 'cores', 'mean', 'paper', 'longest island of all islands\u2019 time', 'serial [Hz]',
                  'islands parallel [Hz]', 'and spaces [Hz]', 'collision, serial', 'collision, islands parallel'], 'th'));
for (const {name, cores: c} of scenes) {
  cores.append(row([name, c.cores, number(c.cores_mean, 1), c.paper_cores ?? '\u2013', percent(c.longest_island_share),
                    ...kinds.map((kind) => number(c[kind.key].harmonic_mean_hz, 1)), percent(c.collide_share.serial),
                    percent(c.collide_share.islands_parallel)], 'td'));
}
for (const id of ['islands', 'cores']) pb.scrollable(document.getElementById(id).parentElement, id);

const stills = scenes.filter((scene) => scene.still !== null);
document.getElementById('gallery').hidden = stills.length === 0;
for (const {name, still} of stills) {
  document.getElementById('stills').append(pb.element('figure', {}, pb.element('img', {src: still, alt: name}), pb.element('figcaption', {}, name)));
}
pb.showProvenance();
document.body.dataset.ready = 'yes';
