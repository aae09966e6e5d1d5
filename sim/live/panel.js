// The controls: what the user asks for goes to the program, what the program says is shown. A control that is
// being used is left alone.
const live = {
  state: null,
  began: 0,     // simulated time since when the rig is as it is: earlier points are of another one
  recorded: 0,  // when the recording began
  sweep: null,  // the last one
  wrong: null,  // the control whose value was refused
};

/** Commands on their way: of each kind the last one that was asked for, and the control that asks. */
const asked = new Map();
let sending = false;
function ask(kind, command, control) {
  asked.set(kind, {command, control});
  if (!sending) send();
}
async function send() {
  sending = true;
  while (asked.size > 0) {
    const [kind, {command, control}] = asked.entries().next().value;
    asked.delete(kind);
    try {
      const answer = await fetch(
          'do',
          {method: 'POST', headers: {'Content-Type': 'application/json'}, body: JSON.stringify(command)});
      const {refused} = await answer.json();
      if (byId('message').classList.contains('refused')) say('');
      refusal.textContent = refused;
      if (refused !== '') refuse(control);
    } catch {
      say('The program does not answer.', true);
    }
  }
  sending = false;
}

/** Why something is not done, below the control that asked for it, which has the rig's value again. */
const refusal = make('p', {class: 'refused small', role: 'alert'});
function refuse(control) {
  const row = control.closest('.line, .switch, .warning');
  if (row.nextSibling !== refusal) row.after(refusal);
  putBack(control);
}
function putBack(control) {
  live.wrong = control;
  showControls(live.state);
  showSweep(live.sweep);
  const now = samples.at(samples.newest());
  showCurrents(live.state.sweep ? currentColumns.map((name) => now[name]) : live.state.wanted);
  live.wrong = null;
}

/** In the line that is read out. */
function say(text, refused = false) {
  byId('message').textContent = text;
  byId('message').classList.toggle('refused', refused);
}

const inUse = (element) => element === document.activeElement && element !== live.wrong;
const number = (id) => Number(byId(id).value);
const rowOf = (name) => document.querySelector(`.switch[data-effect='${name}']`);
const effectOf = (name) => live.state.effects.find((one) => one.name === name);

/** The slider and the number of a muscle's command. */
const currentIds = (muscle) => [`${command.name}-${muscle}`, `${command.name}-${muscle}-number`];
function setCurrent(muscle, from) {
  if (byId(from).value === '') return putBack(byId(from));
  for (const id of currentIds(muscle))
    if (id !== from) byId(id).value = byId(from).value;
  ask(muscle === 1 ? 'current' : 'current 2', {do: 'command', to: number(from), muscle}, byId(from));
}
function setLoad(from) {
  if (byId(from).value === '') return putBack(byId(from));
  const kg = from === 'load' ? Number(number('load').toPrecision(3)) : number(from);
  byId(from === 'load' ? 'load-number' : 'load').value = kg;
  ask('load', {do: 'load', kg}, byId(from));
}
const sweepIds = ['low', 'high', 'period'];
function setSweep(shape, control) {
  if (sweepIds.some((id) => byId(id).value === '')) return putBack(control);
  const ends = Object.fromEntries(sweepIds.map((id) => [id, number(id)]));
  const command = shape === '' ? {do: 'command', to: live.state.wanted[0]} : {do: 'sweep', shape, ...ends};
  ask('current', command, control);
}
function setEffect(name, on, size, shape) {
  ask('effect ' + name, {do: 'effect', name, on, size, shape: shape ?? 0}, rowOf(name));
}

function allOff() {
  for (const one of live.state.effects)
    if (one.on) setEffect(one.name, false, one.size, one.shape);
}

/** A slider of an effect. Sizes go evenly, shapes by their logarithm. */
function dialOf(one, which, label) {
  const {least, most} = one[which], even = which === 'size';
  const to = even ? (part) => least + part * (most - least) : (part) => least * (most / least) ** part;
  const input = make('input', {
    type: 'range',
    min: 0,
    max: 1,
    step: 0.005,
    'data-dial': which,
    'aria-label': `${label} of ${one.name}`
  });
  input.from = (value) =>
      even ? (value - least) / (most - least) : Math.log(value / least) / Math.log(most / least);
  input.addEventListener('input', () => {
    const now = effectOf(one.name);
    now[which] = to(Number(input.value));
    setEffect(one.name, true, now.size, now.shape);
  });
  return make('div', {class: 'dial'}, make('span', {}, label), input, make('output', {'data-says': which}));
}

/** As words: "muscle leak", "bladder elasticity linear". */
const inWords = (name) => name.replaceAll('_', ' ');

/** Beside the list of guesses. */
const answer = (text) => {
  byId('answer').textContent = text;
};

/** For lessons: the program lets one act that is not shown, plain enough to be seen. */
const hidden = () => live.state.hidden;
function hideOne() {
  const off = live.state.effects.filter(({on}) => !on);
  const oneOf = (list) => list[Math.floor(Math.random() * list.length)];
  const {name, shape} = oneOf(off);
  const [near, far] = oneOf(report.switches.find((one) => one.name === name).plain_sizes);
  const size = near + Math.random() * (far - near);
  ask('hide', {do: 'hide', name, size, shape: shape ?? 0}, byId('hide'));
}
function showHidden() {
  const one = hidden() !== '';
  byId('hide').hidden = one;
  byId('all-off').disabled = one;
  byId('guess-line').hidden = byId('give-up').hidden = !one;
  if (one) offer(hidden());
  byId('guess').value = '';
  const others = pair ? '' : ' and another load';
  if (one)
    answer(
        'One effect is at work. Look at the loops, and choose which one it is. ' +
        `If nothing shows, try stairs${others}.`);
}

/** A few to choose from, the hidden one among them, the same in all pages; then all others. */
const few = 5;
function offer(right) {
  const spread = (name) => [...right + name].reduce((sum, c) => (31 * sum + c.charCodeAt(0)) % 65521, 7);
  const names = report.switches.map(({name}) => name);
  const drawn = names.filter((name) => !effectOf(name).on).sort((a, b) => spread(a) - spread(b));
  const first = new Set([right, ...drawn.slice(0, few - 1)]);
  const group = (label, is) => make(
      'optgroup', {label}, ...names.filter(is).map((name) => make('option', {value: name}, inWords(name))));
  byId('guess').replaceChildren(
      make('option', {value: ''}, '-'), group('one of these', (name) => first.has(name)),
      group('all others', (name) => !first.has(name)));
}
function guess(name) {
  if (name === '') return;
  if (name !== hidden()) return answer(`It is not ${inWords(name)}.`);
  reveal('Right: ');
}
function reveal(before) {
  const {name, says} = effectOf(hidden());
  answer(`${before}${inWords(name)}, ${says}.`);
  ask('show', {do: 'show'}, byId('give-up'));
}

function makeSwitches() {
  byId('switches').replaceChildren(...report.switches.map((one) => {
    const tick = make('input', {type: 'checkbox'});
    tick.addEventListener('change', () => {
      const now = effectOf(one.name);
      setEffect(one.name, tick.checked, now.size, now.shape);
    });
    const dials = make(
        'div', {hidden: ''}, dialOf(one, 'size', 'size'),
        ...(one.shape ? [dialOf(one, 'shape', 'shape')] : []));
    return make(
        'div', {class: 'switch', 'data-effect': one.name, title: one.law},
        make('label', {class: 'name'}, tick, inWords(one.name)), make('p', {}, one.says), dials);
  }));
}

function showSwitches(effects) {
  for (const now of effects) {
    const row = rowOf(now.name);
    const on = now.on && now.name !== hidden();
    row.classList.toggle('on', on);
    row.querySelector('input[type=checkbox]').checked = on;
    row.querySelector('input[type=checkbox]').disabled = hidden() !== '';
    row.lastElementChild.hidden = !on;
    for (const which of ['size', 'shape']) {
      const dial = row.querySelector(`[data-dial=${which}]`);
      if (!dial) continue;
      if (!inUse(dial)) dial.value = dial.from(now[which]);
      row.querySelector(`[data-says=${which}]`).textContent = which === 'size' ? now.says : now.shape_says;
      dial.setAttribute('aria-valuetext', which === 'size' ? now.says : now.shape_says);
    }
  }
}

/** What tells one rig from another: sizes apart, that may be on their way. */
const rigOf = (state) =>
    JSON.stringify([state.load_kg, ...state.effects.filter((one) => one.on).map((one) => one.name)]);

function showState(state) {
  const before = live.state;
  live.state = state;
  if (before && rigOf(before) !== rigOf(state)) keepLoops(false);
  if (before && JSON.stringify(before.effects) !== JSON.stringify(state.effects))
    live.began = samples.newest();
  showControls(state);
  if (state.hidden !== (before?.hidden ?? '')) showHidden();
  if (!state.sweep && (!before || before.sweep)) showCurrents(state.wanted);
  byId('pause').textContent = state.running ? 'Pause' : 'Go on';
  byId('pace').hidden = state.pace > 0.9;
  byId('pace').textContent = `This machine makes ${state.pace.toFixed(2)} s of a second.`;
  if (state.recording && !before?.recording) live.recorded = samples.newest();
  byId('record').textContent = state.recording ? 'Stop recording' : 'Record';
  byId('record').setAttribute('aria-pressed', state.recording);
  byId('recording').hidden = !state.recording;
  byId('alarm').hidden = state.failure === '';
  byId('alarm-text').textContent = state.failure === '' ? '' : 'The integration failed. ' + state.failure;
  if (state.message.number > 0 && state.message.number !== before?.message.number) say(state.message.text);
}

function showControls(state) {
  showSwitches(state.effects);
  for (const button of document.querySelectorAll('[data-sweep]'))
    button.setAttribute('aria-pressed', button.dataset.sweep === (state.sweep?.shape ?? ''));
  for (const id of pair ? [] : ['load', 'load-number'])
    if (!inUse(byId(id))) byId(id).value = state.load_kg;
  if (state.sweep) showSweep(state.sweep);
}

function showSweep(sweep) {
  live.sweep = sweep;
  for (const id of sweepIds)
    if (!inUse(byId(id))) byId(id).value = sweep[id];
}

/** Sliders go along with a sweep. */
function showCurrents(values) {
  values.forEach((value, i) => {
    for (const id of currentIds(i + 1))
      if (!inUse(byId(id))) byId(id).value = value.toFixed(2);
  });
}

function prepareControls() {
  const {zero, span} = command, {lowest, largest} = report.dac;
  const muscles = currentColumns.map((_, i) => i + 1);
  /** A slider acts while it moves, a number once it is whole. */
  const onSet = (id, set) =>
      byId(id).addEventListener(byId(id).type === 'range' ? 'input' : 'change', () => set(id));
  for (const id of [...muscles.flatMap(currentIds), 'low', 'high']) {
    byId(id).min = lowest;
    byId(id).max = largest;
  }
  showSweep({low: zero, high: Math.min(largest, span), period: 10});
  byId('from-rest').disabled = pair;  // what else their data sets cannot say
  makeSwitches();
  for (const muscle of muscles)
    for (const id of currentIds(muscle)) onSet(id, () => setCurrent(muscle, id));
  if (!pair) {
    const {least_kg, most_kg} = report.loads;
    Object.assign(byId('load'), {
      min: Math.max(least_kg, Number((0.1 * report.load_kg).toPrecision(2))),
      max: Math.min(most_kg, Number((4 * report.load_kg).toPrecision(2)))
    });
    Object.assign(byId('load-number'), {min: least_kg, max: most_kg});
    for (const id of ['load', 'load-number']) onSet(id, setLoad);
  }
  for (const button of document.querySelectorAll('[data-sweep]'))
    button.addEventListener('click', () => setSweep(button.dataset.sweep, button));
  for (const id of sweepIds)
    onSet(id, () => {
      if (live.state.sweep) setSweep(live.state.sweep.shape, byId(id));
    });
  const asks = (id, kind, command) =>
      byId(id).addEventListener('click', () => ask(kind, command(), byId(id)));
  asks('pause', 'run', () => ({do: 'run', on: !live.state.running}));
  asks('again', 'again', () => ({do: 'again'}));
  asks('alarm-again', 'again', () => ({do: 'again'}));
  asks(
      'record', 'record',
      () => live.state.recording ? {do: 'stop'} : {do: 'record', from_rest: byId('from-rest').checked});
  byId('hide').addEventListener('click', hideOne);
  byId('guess').addEventListener('change', () => guess(byId('guess').value));
  byId('give-up').addEventListener('click', () => reveal('It was '));
  byId('all-off').addEventListener('click', allOff);
  document.addEventListener('keydown', (event) => {
    if (event.key !== ' ' || event.target.closest('input, select, button, summary, a')) return;
    event.preventDefault();
    byId('pause').click();
  });
}
