// Second half of the report's script: tables, pictures, and the page, drawn from the constant
// `report`, the contents of report.json.

// Tables. Each cell of a column is [number, what stands small below it]; v is null in the row of
// one snapshot, where what belongs to the whole variant is left out.

const percent = (share) => known(share) ? `${number(100 * share)} %` : '–';
const mega = (rays) => known(rays) ? rays / 1e6 : null;
const COLUMNS = [
  ['parse', 's', (s, v) => v ? [number(v.parseSeconds)] : []],
  ['build', 's', (s, v) => v ? [number(v.buildSeconds)] : []],
  ['samples', 'per pixel', (s) => [count(s.samples), s.seeds > 1 ? `${s.seeds} seeds` : '']],
  ['render', 's', (s) => [number(s.seconds), plusMinus(s.secondsError)]],
  ['CPU', 's', (s) => [number(s.cpuSeconds)]],
  ['rays', 'million', (s) => [number(mega(s.rays))]],
  ['rays / s', 'million', (s) => [number(s.seconds > 0 ? mega(s.rays) / s.seconds : null)]],
  ['RMSE', '', (s) => [number(s.rmse), plusMinus(s.rmseError)]],
  ['relMSE', '', (s) => [number(s.relMse), plusMinus(s.relMseError)]],
  ['MAE', '', (s) => [number(s.mae), plusMinus(s.maeError)]],
  ['FLIP', '', (s) => [number(s.flip), plusMinus(s.flipError)]],
  [
    'beyond 3σ', 'of blocks',
    (s) => [percent(s.biasShare), known(s.biasZ) ? `z ${number(s.biasZ, 2)}` : '']
  ],
  ['slope', '', (s, v) => v ? [number(v.slope?.value), plusMinus(v.slope?.error)] : []],
  ['efficiency', '1 / s', (s) => [number(s.efficiency)]],
];

const last = (variant) => variant.snapshots.at(-1) ?? {};

function table(scene, variants) {
  const baseline = last(variants[0]).efficiency;
  const relative = (s) => known(s.efficiency) && baseline > 0 ? s.efficiency / baseline : null;
  const best = Math.max(...variants.map((v) => last(v).efficiency ?? 0));
  const row = (head, s, v) => {
    const cells = COLUMNS.map(([, , cell]) => {
      const [text = '', below = ''] = cell(s, v);
      return html('td', {}, text, html('small', {}, below));
    });
    const times = known(relative(s)) ? `× ${number(relative(s))}` : '–';
    cells.push(html('td', v && s.efficiency === best ? {class: 'best'} : {}, times));
    return html('tr', {}, html('th', {scope: 'row'}, head), ...cells);
  };
  const heads = [...COLUMNS, ['relative', 'efficiency']].map(
      ([name, unit]) => html('th', {scope: 'col'}, name, html('small', {}, unit)));
  const bodies = variants.flatMap((v) => {
    const button = html('button', {type: 'button', 'aria-expanded': false}, v.label);
    const statements = html('td', {colspan: heads.length + 1}, html('code', {}, v.statements));
    const snapshots = html(
        'tbody', {class: 'snapshots', hidden: ''}, html('tr', {}, statements),
        ...v.snapshots.map((s, i) => row(`snapshot ${i + 1}`, s, null)));
    button.addEventListener('click', () => {
      snapshots.hidden = !snapshots.hidden;
      button.setAttribute('aria-expanded', !snapshots.hidden);
    });
    return [html('tbody', {}, row(button, last(v), v)), snapshots];
  });
  return html(
      'div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': `numbers of ${scene}`},
      html(
          'table', {},
          html(
              'caption', {class: 'quiet'},
              'The last snapshot of each variant; open one for all of its snapshots. Relative ' +
                  'efficiency: against the last snapshot of the first variant.'),
          html('thead', {}, html('tr', {}, html('th', {scope: 'col'}, 'variant'), ...heads)),
          ...bodies));
}

// Pictures

function picture(source, name, ...caption) {
  return html(
      'figure', {}, source ? html('img', {src: source, alt: name}) : '–',
      html('figcaption', {}, ...caption));
}

function pictures(variant) {
  const {label, snapshots} = variant, s = last(variant);
  return html(
      'section', {class: 'variant'}, html('h3', {}, label),
      picture(variant.picture, label, `${count(s.samples)} spp, RMSE ${number(s.rmse)}`),
      picture(
          variant.errorMap, `FLIP error of ${label}`, `FLIP ${number(s.flip)}: 0`,
          html('span', {class: 'scale'}), '1'),
      html(
          'div', {class: 'strip'},
          ...snapshots.map(
              (t) => picture(
                  t.thumbnail, `${label}, ${t.samples} samples per pixel`,
                  `${count(t.samples)} spp`))));
}

// Two pictures in one place, with a divider to drag or to be flipped. An invisible range input over
// the picture is the divider, and an invisible button flips, so that keys and screen readers work.
function comparison(scene, variants, references) {
  const choices = [
    ...variants.map((v) => ({name: v.label, source: v.picture})),
    ...references.map((r) => ({name: 'reference', source: r.picture})),
    ...variants.map((v) => ({name: `FLIP error of ${v.label}`, source: v.errorMap})),
  ].filter((choice) => choice.source);
  if (choices.length < 2) return '';
  const names = choices.map((choice) => choice.name);
  const select = {
    a: html('select', {}, ...options(names)),
    b: html('select', {}, ...options(names)),
    mode: html('select', {}, ...options({slide: 'slider', flip: 'flip'})),
    zoom: html('select', {}, ...options({0: 'to fit', 1: '1×', 2: '2×', 4: '4×', 8: '8×'})),
  };
  select.b.value = Math.max(names.indexOf('reference'), 1);
  const label = {a: html('output', {class: 'a'}), b: html('output', {class: 'b'})};
  const image = {a: html('img', {class: 'a', draggable: false}), b: html('img', {class: 'b'})};
  const divider = html('div', {class: 'divider'});
  const slider = html('input', {
    type: 'range',
    min: 0,
    max: 100,
    step: 0.5,
    value: 50,
    'aria-label': 'place of the divider, per cent'
  });
  const flip = html('button', {type: 'button', 'aria-label': 'flip between the two pictures'});
  const stage =
      html('div', {class: 'stage'}, image.a, image.b, divider, label.a, label.b, slider, flip);
  let flipped = false, pressedAt = null;

  function update() {
    const flips = select.mode.value === 'flip', zoom = Number(select.zoom.value);
    for (const side of ['a', 'b']) {
      const {name, source} = choices[select[side].value];
      if (image[side].getAttribute('src') !== source) image[side].src = source;
      image[side].alt = label[side].value = name;
    }
    const {width, height} = references[0];
    stage.style.setProperty('--aspect', width / height);
    stage.style.setProperty('--width', `${width}px`);
    stage.style.setProperty('--zoom', zoom);
    stage.classList.toggle('zoomed', zoom > 0);
    stage.classList.toggle('pixels', stage.clientWidth > width);
    slider.hidden = divider.hidden = flips;
    flip.hidden = !flips;
    label.a.hidden = flips && flipped;
    label.b.hidden = flips && !flipped;
    divider.style.left = `${slider.value}%`;
    // Picture b lies over a, cut off left of the divider, or shown whole or not at all.
    image.b.style.clipPath = flips ? '' : `inset(0 0 0 ${slider.value}%)`;
    image.b.hidden = flips && !flipped;
  }
  // A short press flips; a long one flips for as long as it is held.
  function press() {
    if (pressedAt !== null) return;
    pressedAt = performance.now();
    flipped = !flipped;
    update();
  }
  function release() {
    if (pressedAt === null) return;
    if (performance.now() - pressedAt > 400) flipped = !flipped;
    pressedAt = null;
    update();
  }
  flip.addEventListener('pointerdown', press);
  for (const end of ['pointerup', 'pointercancel', 'pointerleave', 'blur']) {
    flip.addEventListener(end, release);
  }
  for (const [kind, action] of [['keydown', press], ['keyup', release]]) {
    flip.addEventListener(kind, (event) => {
      if (event.key !== ' ' && event.key !== 'Enter') return;
      event.preventDefault();
      action();
    });
  }
  slider.addEventListener('input', update);
  for (const choice of Object.values(select)) choice.addEventListener('change', update);
  addEventListener('resize', update);
  return {
    update,
    node: html(
        'section', {class: 'compare'}, html('h3', {}, 'Compare'),
        html(
            'form', {'aria-label': `pictures of ${scene} to compare`},
            html('label', {}, 'left ', select.a), html('label', {}, 'right ', select.b),
            html('label', {}, 'by ', select.mode), html('label', {}, 'zoom ', select.zoom)),
        html('div', {class: 'window'}, stage)),
  };
}

// The page

function referenceText({description, samples, rmse, width, height}) {
  const taken = known(samples) ? `, ${count(samples)} samples per pixel` : '';
  const own = known(rmse) ? `its own expected RMSE is ${number(rmse)}` : 'its own error is unknown';
  return `Reference: ${description}${taken}, ${width} × ${height} pixels; ${own}.`;
}

// One scene: its references, plot, table, comparison and pictures. Returns what is to be drawn anew
// when the page changes.
function section(scene) {
  const variants = report.variants.filter((v) => v.scene === scene);
  const references = [...new Set(variants.map((v) => report.references[v.reference]))];
  const plot = new Plot(variants, references);
  const compare = comparison(scene, variants, references);
  document.getElementById('scenes').append(html(
      'section', {class: 'scene'}, html('h2', {}, scene),
      ...references.map((r) => html('p', {class: 'quiet'}, referenceText(r))), plot.node,
      table(scene, variants), compare.node ?? '', ...variants.map(pictures)));
  compare.update?.();
  return plot;
}

function page() {
  const text = (id, ...parts) => document.getElementById(id).append(...parts);
  const {title, date, software, machine, threads, interleaved, command, notes} = report;
  document.title = title;
  text('title', title);
  text('facts', [
    date.replace('T', ' '), software, machine, `${threads} ${threads === 1 ? 'thread' : 'threads'}`,
    ...(interleaved ? ['variants interleaved'] : [])
  ].join(' · '));
  text('command', command);
  text('notes', ...notes.map((note) => html('li', {}, note)));

  const metric = document.getElementById('metric'), axis = document.getElementById('axis');
  metric.append(...Object.entries(METRICS).map(([value, {name}]) => html('option', {value}, name)));
  axis.append(...options(AXES));
  const plots = [...new Set(report.variants.map((v) => v.scene))].map(section);
  const draw = () => plots.forEach((plot) => plot.draw(metric.value, axis.value));
  for (const choice of [metric, axis]) choice.addEventListener('change', draw);
  addEventListener('resize', draw);
  draw();
}
page();
