'use strict';
// The head of the page, its numbers, and the fold-out tables.

pb.showHeader = () => {
  const about = pb.about;
  const byId = (id) => document.getElementById(id);
  const attribute = (name) => about.attributes[name] || '';

  byId('subtitle').textContent = attribute('command_line');
  const badge = byId('complete');
  badge.textContent = about.complete ? 'complete' : `cut off after ${about.frames_committed} frames`;
  badge.classList.toggle('cut-off', !about.complete);
  byId('state-hash').textContent = attribute('state_hash').trim() || 'none';

  byId('facts').append(...about.facts.map((fact) => pb.element('dl', {className: 'fact', style: 'margin:0'},
      pb.element('dt', {}, fact.label),
      pb.element('dd', {},
          pb.element('div', {className: 'value'}, fact.value),
          pb.element('div', {className: 'detail'}, fact.note)))));

  const cell = (text) => text.includes('\n') ? pb.element('td', {}, pb.element('pre', {}, text)) :
                                               pb.element('td', {}, text);
  const table = (entries) => pb.element('table', {}, ...entries.map(
      ([name, text]) => pb.element('tr', {}, pb.element('th', {scope: 'row'}, name), cell(text))));
  const entries = Object.entries({...about.attributes, ...about.parameters});
  const isEnvironment = ([name]) => name.startsWith('env_');
  byId('settings-tables').append(table(entries.filter((entry) => !isEnvironment(entry))));
  const environment = entries.filter(isEnvironment).map(([name, text]) => [name.slice('env_'.length), text]);
  byId('environment').hidden = environment.length === 0;
  byId('environment-table').append(table(environment));

  byId('events').hidden = about.events.length === 0;
  byId('event-list').append(...about.events.map((event) => pb.element('li', {}, event)));

  const made = [`pbmpi ${attribute('pbmpi_version')}`, attribute('git_revision'), attribute('created')];
  byId('provenance').textContent = made.filter((part) => part).join(' · ');
};
