'use strict';
// The head of the page, its numbers, and the events.

pb.showHeader = () => {
  const about = pb.about;
  const byId = (id) => document.getElementById(id);
  const attribute = (name) => about.attributes[name] || '';

  byId('subtitle').textContent = attribute('command_line');
  const badge = byId('complete');
  badge.textContent = about.complete ? 'complete' : `cut off after ${about.frames_committed} frames`;
  badge.classList.toggle('cut-off', !about.complete);
  byId('state-hash').textContent = attribute('state_hash').trim() || 'none';

  byId('facts').append(...about.facts.map((fact) => pb.element('dl', {className: 'fact'},
      pb.element('dt', {}, fact.label),
      pb.element('dd', {},
          pb.element('div', {className: 'value'}, fact.value),
          pb.element('div', {className: 'detail'}, fact.note)))));

  byId('events').hidden = about.events.length === 0;
  byId('event-list').append(...about.events.map((event) => pb.element('li', {}, event)));
};
