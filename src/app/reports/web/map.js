'use strict';
// The map of hard cases: a field a case and a setting, which opens its curves and its replay. The address opens one, too:
//   #case=hard/rest/column10&setting=quick, 1 x 20

pb.Map = class {
  constructor(data) {
    this.data = data;
    this.charts = [];
    this.byId = (id) => document.getElementById(id);
    this.byId('replay').hidden = true;
    this.byId('map').append(this.head(), ...this.groups());
    this.byId('map').addEventListener('keydown', (event) => this.go(event));
    window.addEventListener('hashchange', () => this.readAddress());
  }

  // Arrows go from field to field, over the headings of groups, too.
  go(event) {
    const [, row, column] = (event.target.id.match(/^field-(\d+)-(\d+)$/) || []).map(Number);
    const step = {ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0]}[event.key];
    if (row === undefined || !step) return;
    event.preventDefault();
    const rows = [...this.byId('map').querySelectorAll('tr:has(button)')];
    const line = rows.indexOf(event.target.closest('tr')) + step[0];
    const next = rows[line] && rows[line].querySelectorAll('button')[column + step[1]];
    if (next) next.focus();
  }

  readAddress() {
    const asked = new URLSearchParams(location.hash.slice(1));
    const row = this.data.rows.findIndex((one) => one.name === asked.get('case'));
    const column = this.data.columns.indexOf(asked.get('setting'));
    if (row >= 0 && column >= 0) this.byId(`field-${row}-${column}`).click();
  }

  head() {
    return pb.element('thead', {}, pb.element('tr', {}, pb.element('th', {scope: 'col'}, 'case'),
        ...this.data.columns.map((column) => pb.element('th', {scope: 'col'}, column))));
  }

  groups() {
    const names = [...new Set(this.data.rows.map((row) => row.group))];
    return names.map((name) => pb.element('tbody', {},
        pb.element('tr', {className: 'group'}, pb.element('th', {colSpan: this.data.columns.length + 1}, name)),
        ...this.data.rows.filter((row) => row.group === name).map((row) => this.line(row))));
  }

  line(row) {
    return pb.element('tr', {}, pb.element('th', {scope: 'row', title: row.oracle}, row.name.split('/').pop()),
        ...row.cells.map((cell, column) => pb.element('td', {}, this.field(row, cell, column))));
  }

  field(row, cell, column) {
    const look = cell.verdict === 'n/a' ? 'na' : cell.verdict;
    const button = pb.element('button', {
      type: 'button', id: `field-${this.data.rows.indexOf(row)}-${column}`, className: cell.severity > 0.5 ? `${look} far` : look,
    }, cell.label || (cell.verdict === 'pass' ? '\u2713' : cell.verdict));
    button.setAttribute('aria-label', `${row.name}, ${this.data.columns[column]}: ${cell.verdict} ${cell.label}`);
    button.addEventListener('click', () => this.choose(row, cell, column, button));
    return button;
  }

  choose(row, cell, column, button) {
    if (this.button) this.button.classList.remove('chosen');
    this.button = button;
    button.classList.add('chosen');
    this.byId('chosen').hidden = false;
    this.byId('chosen-title').textContent = `${row.name}, ${this.data.columns[column]}: ${cell.verdict}`;
    this.byId('chosen-oracle').textContent = `${row.oracle} (${row.source})`;
    this.byId('chosen-detail').textContent = cell.detail;
    this.showCurves(cell.curves);
    this.showReplay(row, cell.replay);
  }

  showCurves(curves) {
    for (const end of this.charts) end();
    this.byId('curves').replaceChildren();
    this.charts = curves.map((curve) => this.chart(curve));
  }

  // Returns what ends the chart.
  chart(curve) {
    const area = pb.element('div', {className: 'area', style: 'height:190px'});
    this.byId('curves').append(pb.element('article', {className: 'chart'}, pb.element('h3', {}, `${curve.title} [${curve.unit}]`), area));
    const times = pb.floats(curve.time_s), values = pb.floats(curve.value);
    const text = (item) => `${curve.title.toLowerCase()} ${pb.shortNumber(item.raw.y)} ${curve.unit} at ${pb.shortNumber(item.raw.x)} s`;
    return pb.draw(area, `${curve.title} over time`, () => ({
      type: 'line',
      data: {datasets: [{label: curve.title, data: Array.from(times, (x, i) => ({x, y: values[i]})), borderColor: '#0072b2',
                         borderWidth: 1.5, pointRadius: 0}]},
      options: {interaction: {mode: 'nearest', axis: 'x', intersect: false},
                plugins: {legend: {display: false}, tooltip: {callbacks: {title: () => [], label: text}}},
                scales: {x: {type: 'linear', min: 0, title: {display: true, text: 's'}},
                         y: values.every((value) => value === 0) ? {min: 0, suggestedMax: 1} : {}}},
    }), pb.readByKeyboard);
  }

  showReplay(row, replay) {
    this.byId('replay').hidden = replay === null;
    if (replay === null) return;
    pb.about.scene = row.name;
    const data = pb.decodeReplay(replay);
    if (this.replay) this.replay.show(data); else this.replay = pb.startReplay(data);
  }
};

pb.map = new pb.Map(pb.json('map-data'));
pb.map.readAddress();
pb.showProvenance();
document.body.dataset.ready = 'yes';
