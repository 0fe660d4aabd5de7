'use strict';
// A page of charts and tables, from JSON.

// Returns what draws the chart into its place.
pb.addChart = (parent, chart) => {
  const area = pb.element('div', {className: 'area'});
  parent.append(pb.element('article', {className: 'chart'}, pb.element('h3', {}, chart.title), pb.element('p', {}, chart.text), area));
  return () => pb.draw(area, `${chart.title}: ${chart.text}`, () => structuredClone(chart.config), pb.readByKeyboard);
};

// A column is one of numbers if all its cells are short; such cells do not wrap.
pb.addTable = (parent, table) => {
  const wide = table.header.map((_, column) => table.rows.some((row) => (row[column] || '').length > 24));
  const line = (tag, cells, looks = []) => pb.element('tr', {}, ...cells.map((cell, column) =>
      pb.element(tag, {className: [wide[column] && 'words', looks[column]].filter(Boolean).join(' ')}, cell)));
  const head = line('th', table.header);
  for (const cell of head.children) cell.scope = 'col';
  parent.append(pb.element('h3', {className: 'table-title'}, table.title), pb.scrollable(pb.element('div', {className: 'table'},
      pb.element('table', {}, pb.element('thead', {}, head), pb.element('tbody', {}, ...table.rows.map((cells, row) => line('td', cells, table.looks[row]))))),
      table.title));
};

pb.addPictures = (parent, pictures) => {
  const shown = pictures.map(({name, png}) => pb.element('figure', {}, pb.element('img', {alt: name, src: `data:image/png;base64,${png}`}),
                                                         pb.element('figcaption', {}, name)));
  parent.append(pb.element('div', {className: 'pictures'}, ...shown));
};

// Paragraphs; a command to copy is set as such.
pb.addParagraphs = (parent, text) => {
  for (const part of text.split('\n\n').filter((one) => one)) {
    const command = part.match(/^(.*: )(mpirun .*)$/);
    parent.append(pb.element('p', {}, ...(command ? [command[1], pb.element('code', {}, command[2])] : [part])));
  }
};

for (const section of pb.json('sections-data')) {
  const card = pb.element('section', {className: 'card section'}, pb.element('h2', {}, section.title));
  pb.addParagraphs(card, section.text);
  document.getElementById('sections').append(card);
  const grid = pb.element('div', {className: 'chart-grid'});
  card.append(grid);
  const places = section.charts.map((chart) => pb.addChart(grid, chart));
  for (const draw of places) draw();  // only now are they as wide as they stay
  for (const table of section.tables) pb.addTable(card, table);
  if (section.pictures) pb.addPictures(card, section.pictures);
  pb.addParagraphs(card, section.last || '');
}
pb.showProvenance();
document.body.dataset.ready = 'yes';
