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
    window.addEventListener('hashchange', () => this.readAddress());
  }

  readAddress() {
    const asked = new URLSearchParams(location.hash.slice(1));
    const row = this.data.rows.findIndex((one) => one.name === asked.get('case'));
    const column = this.data.columns.indexOf(asked.get('setting'));
    if (row >= 0 && column >= 0) this.byId(`field-${row}-${column}`).click();
  }

  head() {
    return pb.element('thead', {}, pb.element('tr', {}, pb.element('th', {}, 'case'),
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
      type: 'button', id: `field-${this.data.rows.indexOf(row)}-${column}`, className: cell.severity > 0.5 ? `${look} far` : look, title: cell.label || cell.verdict,
    }, cell.label || (cell.verdict === 'pass' ? '' : cell.verdict));
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
    for (const chart of this.charts) chart.destroy();
    this.byId('curves').replaceChildren();
    this.charts = curves.map((curve) => this.chart(curve));
  }

  chart(curve) {
    const canvas = pb.element('canvas', {role: 'img'});
    canvas.setAttribute('aria-label', `${curve.title} over time`);
    this.byId('curves').append(pb.element('article', {className: 'chart'}, pb.element('h3', {}, `${curve.title} [${curve.unit}]`),
        pb.element('div', {className: 'area', style: 'height:190px'}, canvas)));
    const times = pb.floats(curve.time_s), values = pb.floats(curve.value);
    return new Chart(canvas, {
      type: 'line',
      data: {datasets: [{data: Array.from(times, (x, i) => ({x, y: values[i]})), borderColor: '#0072b2', borderWidth: 1.5,
                         pointRadius: 0}]},
      options: {animation: false, maintainAspectRatio: false, plugins: {legend: {display: false}},
                scales: {x: {type: 'linear', title: {display: true, text: 's'}}}},
    });
  }

  showReplay(row, replay) {
    this.byId('replay').hidden = replay === null;
    if (replay === null) return;
    pb.about.scene = row.name;
    const data = pb.decodeReplay(replay);
    if (this.replay) this.replay.show(data); else this.startReplay(data);
  }

  startReplay(data) {
    try {
      this.replay = new pb.Replay(data, new pb.Stage(this.byId('canvas'), data));
    } catch (error) {
      const message = this.byId('view-error');
      message.textContent = `The 3D replay needs WebGL, which this browser does not offer (${error.message}).`;
      message.hidden = false;
      return;
    }
    const loop = (now) => { this.replay.tick(now); requestAnimationFrame(loop); };
    requestAnimationFrame(loop);
  }
};

pb.map = new pb.Map(pb.json('map-data'));
pb.map.readAddress();
document.body.dataset.ready = 'yes';
