// The page moves: news come as server-sent events, each frame of the screen draws the rig a little after they
// were made, so that late news do not make it stumble. Plots take turns: all of them at once, without a
// graphics card, take longer than a frame lasts.
const behind = 0.05;  // seconds by which the page follows
const plotsAFrame = 2;
const drawing = pictureOf(byId('rig'));
const playing = {
  offset: null,
  shown: 0,
  frames: 0,
  turn: 0
};
let timed = [], loops = [], keptByHand = false;

/** How long loops are looked back for: a sweep's period, or some seconds. */
const lookBack = () => live.state?.sweep ? 1.02 * live.state.sweep.period : 10;

/**
 * The loops of now stay, in grey; what follows is another one. Not `byHand`: only if they have gone round, so
 * that several switches in a row leave what was before them, and in place of none that were kept by hand.
 */
function keepLoops(byHand) {
  if (byHand || (!keptByHand && samples.newest() - live.began > 0.8 * lookBack()))
    for (const loop of loops) loop.ghost = loop.values ?? [[], []];
  keptByHand ||= byHand;
  live.began = samples.newest();
}

function makePlots() {
  const ghosts = loops.map(({ghost}) => ghost);
  for (const plot of [...timed, ...loops]) plot.chart.destroy();
  byId('plots').replaceChildren();
  byId('loops').replaceChildren();
  loops = loopPlots.map((plot, i) => new LoopPlot(plot, ghosts[i]));
  timed = timePlots.map((plot) => new TimePlot(plot));
}

function hear(news) {
  if (news.samples) {
    if (samples.add(news.from, news.samples)) {
      keepLoops(false);
      live.began = live.recorded = 0;
    }
    const offset = samples.newest() - behind - performance.now() / 1000;
    if (playing.offset === null || Math.abs(offset - playing.offset) > 0.5) playing.offset = offset;
    playing.offset += 0.05 * (offset - playing.offset);
  }
  if (news.state) showState(news.state);
}

function frame() {
  requestAnimationFrame(frame);
  const values = live.state && samples.at(samples.newest());
  if (!values) return;
  const still = !live.state.running || live.state.failure !== '';
  const now =
      still ? samples.newest() : Math.min(samples.newest(), playing.offset + performance.now() / 1000);
  const seen = samples.at(now);
  playing.shown = now;
  ++playing.frames;
  drawing.draw(seen, {}, live.state.load_kg);
  const plots = timed.length + loops.length;
  for (let i = 0; i < plotsAFrame; ++i) {
    const which = playing.turn++ % plots;
    if (which < timed.length)
      timed[which].draw(now, number('span'));
    else
      loops[which - timed.length].draw(Math.max(now - lookBack(), live.began), now);
  }
  write(byId('clock'), now.toFixed(1) + ' s');
  if (live.state.recording)
    write(byId('recording'), `recording, ${Math.max(0, now - live.recorded).toFixed(1)} s`);
  if (live.state.sweep) showCurrents(currentColumns.map((name) => seen[name]));
}

prepareControls();
makePlots();
byId('rig-caption').textContent = `The rig, ${drawing.scale}.`;
byId('keep').addEventListener('click', () => keepLoops(true));
byId('forget').addEventListener('click', () => {
  for (const loop of loops) loop.ghost = [[], []];
  keptByHand = false;
});
for (const choice of document.querySelectorAll('.unit-choice input'))
  choice.addEventListener('change', makePlots);
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', makePlots);
new ResizeObserver(() => requestAnimationFrame(() => {
                     for (const plot of [...timed, ...loops]) plot.resize();
                   }))
    .observe(document.querySelector('.shown'));  // #plots and #loops have no boxes of their own
const news = new EventSource('news');
news.addEventListener('message', (event) => hear(JSON.parse(event.data)));
news.addEventListener('error', () => say('The program has ended, or cannot be reached.', true));
news.addEventListener('open', () => say(''));
requestAnimationFrame(frame);
