"use strict";
const data = JSON.parse(document.getElementById("score").textContent);
const notes = data.notes, end = data.end;
/* Bars of one length: tick and number of the first, length. That of an upbeat has number -1. */
const spans = [];
for (const [tick, length] of data.bars) {
  const before = spans[spans.length - 1];
  spans.push({tick, length, first: before ? before.first + (tick - before.tick) / before.length : tick < 0 ? -1 : 0});
}
function spanFor(isBefore) {
  let i = spans.length - 1;
  while (i > 0 && !isBefore(spans[i])) --i;
  return spans[i];
}
/* Converts a tick to bars, counted from 0, with a fraction; tickOf() converts back. */
function barAt(tick) {
  const span = spanFor(one => one.tick <= tick);
  return span.first + (tick - span.tick) / span.length;
}
function tickOf(bar) {
  const span = spanFor(one => one.first <= bar);
  return span.tick + (bar - span.first) * span.length;
}
const ONSET = 0, DURATION = 1, KEY = 2, VOICE = 3, VELOCITY = 4, X0 = 5, Y0 = 6, X1 = 7, Y1 = 8;
const GLIDE = 9, SEMITONES = 10, RISE = 11;  // of notes that slide
const element = id => document.getElementById(id);
const button = element("play"), tempo = element("tempo"), place = element("place");
let low = 127, high = 0, longest = 0;
let left = Infinity, right = -Infinity, bottom = Infinity, top_ = -Infinity;
for (const note of notes) {
  const last = note[KEY] + (note[SEMITONES] || 0), lastY = note[Y1] + (note[RISE] || 0);
  low = Math.min(low, note[KEY], last); high = Math.max(high, note[KEY], last);
  longest = Math.max(longest, note[DURATION]);
  left = Math.min(left, note[X0], note[X1]); right = Math.max(right, note[X0], note[X1]);
  bottom = Math.min(bottom, note[Y0], note[Y1], lastY); top_ = Math.max(top_, note[Y0], note[Y1], lastY);
}
const hasCurve = notes.length > 0 && (left < right || bottom < top_);
if (!hasCurve) element("panels").classList.add("flat");

/* The first note that begins at or after a tick. */
function firstFrom(tick) {
  let a = 0, b = notes.length;
  while (a < b) { const m = (a + b) >> 1; if (notes[m][ONSET] < tick) a = m + 1; else b = m; }
  return a;
}
/* Calls f for every note that sounds at some time between two ticks. */
function eachWithin(begin, finish, f) {
  for (let i = firstFrom(begin - longest); i < notes.length && notes[i][ONSET] < finish; ++i) {
    if (notes[i][ONSET] + notes[i][DURATION] > begin) f(notes[i], i);
  }
}

/* Parts: [name, voices]; some may be muted, or others play alone. */
const parts = data.parts, partOfVoice = [], muted = new Set(), alone = new Set();
parts.forEach(([, voices], part) => { for (const voice of voices) partOfVoice[voice] = part; });
const partOf = note => partOfVoice[note[VOICE]];
const isHeard = note => alone.size > 0 ? alone.has(partOf(note)) : !muted.has(partOf(note));
/* Bars that repeat: ticks, or null. */
let loop = null;
/* Ticks at which phrases begin, ascending. */
const phrases = data.phrases;
function firstPhraseFrom(tick) {
  let a = 0, b = phrases.length;
  while (a < b) { const m = (a + b) >> 1; if (phrases[m] < tick) a = m + 1; else b = m; }
  return a;
}

/* Time: ticks against the clock of the sound, from an anchor that moves when tempo or place change. */
let sound = null, playing = false, anchorTick = 0, anchorTime = 0, next = 0, timer = 0;
let past = null;  // the anchor before the last, while a repeat of the loop is ahead
let speed = data.tempo;
const live = new Set();
let pending = [];
let sounded = 0;
let recent = [];
const clock = () => sound ? sound.context.currentTime : performance.now() / 1000;
const ticksPerSecond = () => speed * data.quarter / 60;
/* Where the tempo changes, ticks are longer or shorter: `even` counts ticks of the main tempo, `uneven` is its inverse. */
const stretches = [[0, 0, 1]];  // tick, even ticks before it, factor of the tempo from there on
for (const [tick, factor] of data.tempos || []) {
  const [last, before, old] = stretches[stretches.length - 1];
  stretches.push([tick, before + (tick - last) / old, factor]);
}
function stretchAt(value, column) {
  let a = 0, b = stretches.length - 1;
  while (a < b) { const m = (a + b + 1) >> 1; if (stretches[m][column] <= value) a = m; else b = m - 1; }
  return stretches[a];
}
function even(tick) { const [first, before, factor] = stretchAt(tick, 0); return before + (tick - first) / factor; }
function uneven(ticks) { const [first, before, factor] = stretchAt(ticks, 1); return first + (ticks - before) * factor; }
function tickAt(time) {
  const [tick, from] = past && time < anchorTime ? past : [anchorTick, anchorTime];
  return Math.max(0, playing ? uneven(even(tick) + (time - from) * ticksPerSecond()) : anchorTick);
}
const timeAt = tick => anchorTime + (even(tick) - even(anchorTick)) / ticksPerSecond();
const lasting = (from, to) => (even(to) - even(from)) / ticksPerSecond();
/* Points of pan (number 10) and pitch (-1) by voice. */
const curvesOf = [];
for (const [voice, ...point] of data.controls || []) (curvesOf[voice] = curvesOf[voice] || []).push(point);
const placeOf = value => Math.max(-1, Math.min(1, (value - 64) / 63));
/* Calls f(value, time) for the points of a note: of the pan also for the last one before it. */
function eachPoint(note, number, time, f) {
  const points = curvesOf[note[VOICE]] || [];
  let a = 0, b = points.length;
  while (a < b) { const m = (a + b) >> 1; if (points[m][0] <= note[ONSET]) a = m + 1; else b = m; }
  for (let i = a - 1; i >= 0; --i) {
    if (number !== 10 && points[i][0] < note[ONSET]) break;
    if (points[i][1] !== number) continue;
    f(points[i][2], time);
    break;
  }
  for (; a < points.length && points[a][0] < note[ONSET] + note[DURATION]; ++a) {
    if (points[a][1] === number) f(points[a][2], Math.max(time, timeAt(points[a][0])));
  }
}
/* What is heard now was handed over a moment ago. */
const latency = () => sound && playing ? Math.min(sound.context.outputLatency || 0, 0.5) : 0;
const shownTick = () => Math.min(end, Math.max(past ? 0 : Math.min(anchorTick, end), tickAt(clock() - latency())));

function openSound() {
  const Context = window.AudioContext || window.webkitAudioContext;
  if (sound || !Context) return;
  try {
    const context = new Context();
    const compressor = context.createDynamicsCompressor();
    compressor.threshold.value = -14; compressor.ratio.value = 6;
    const master = context.createGain();
    master.gain.value = 0.55;
    master.connect(compressor); compressor.connect(context.destination);
    sound = {context, master};
  } catch (error) { sound = null; }
}

/* Drums: bass drums and toms are falling tones, all others noise, of metal high and long. */
const drumVoices = new Set(data.drums || []);
const skins = new Set([35, 36, 41, 43, 45, 47, 48, 50, 60, 61, 62, 63, 64, 65, 66]);
const ringing = new Set([46, 49, 51, 52, 53, 55, 57, 59, 81]);
let noise = null;
function beat(note, time) {
  if (!sound) return;
  const {context, master} = sound, key = note[KEY];
  const loud = 0.5 * Math.pow(note[VELOCITY] / 127, 1.6), isSkin = skins.has(key);
  const length = isSkin ? 0.22 : ringing.has(key) ? 0.5 : key === 38 || key === 40 ? 0.16 : 0.07;
  const envelope = context.createGain();
  envelope.gain.setValueAtTime(isSkin ? 1.6 * loud : 0.6 * loud, time);
  envelope.gain.exponentialRampToValueAtTime(0.0005, time + length);
  envelope.connect(master);
  let source;
  if (isSkin) {
    source = context.createOscillator();
    const base = 52 + 7 * Math.max(0, key - 36);
    source.frequency.setValueAtTime(2.2 * base, time);
    source.frequency.exponentialRampToValueAtTime(base, time + 0.07);
    source.connect(envelope);
  } else {
    if (!noise) {
      /* The same noise each time: a generator of Lehmer. */
      noise = context.createBuffer(1, context.sampleRate / 2, context.sampleRate);
      const samples = noise.getChannelData(0);
      for (let i = 0, state = 1; i < samples.length; ++i) {
        state = state * 48271 % 2147483647;
        samples[i] = 2 * state / 2147483647 - 1;
      }
    }
    source = context.createBufferSource();
    source.buffer = noise;
    const filter = context.createBiquadFilter();
    filter.type = key < 42 ? "bandpass" : "highpass";
    filter.frequency.value = key < 42 ? 1800 : 6500;
    source.connect(filter); filter.connect(envelope);
  }
  source.start(time); source.stop(time + length + 0.02);
  const voice = {envelope, oscillators: [source]};
  live.add(voice);
  source.onended = () => { live.delete(voice); envelope.disconnect(); };
}

/* The pitch slides evenly at the end of the note, which may have begun before `time`. */
function slide(note, time, detune) {
  const end = note[ONSET] + note[DURATION], begin = end - note[GLIDE];
  const first = Math.max(time, timeAt(begin)), last = Math.max(first, timeAt(end));
  const done = Math.min(1, Math.max(0, (tickAt(time) - begin) / note[GLIDE]));
  detune.setValueAtTime(100 * note[SEMITONES] * done, first);
  detune.linearRampToValueAtTime(100 * note[SEMITONES], last);
}

/* A soft pluck: a triangle, an octave above it a quiet sine, and a filter that closes as the note fades. */
function strike(note, time, seconds) {
  if (!sound || !isHeard(note)) return;
  if (drumVoices.has(note[VOICE])) return beat(note, time);
  const {context, master} = sound;
  const frequency = 440 * Math.pow(2, (note[KEY] - 69) / 12);
  if (frequency > context.sampleRate / 2.2) return;
  const loud = 0.34 * Math.pow(note[VELOCITY] / 127, 1.6) * Math.min(1, Math.pow(660 / frequency, 0.25));
  const envelope = context.createGain(), filter = context.createBiquadFilter();
  filter.type = "lowpass"; filter.Q.value = 0.4;
  filter.frequency.setValueAtTime(Math.min(16000, frequency * 7 + 500), time);
  filter.frequency.setTargetAtTime(Math.min(12000, frequency * 2.5 + 300), time, 0.35);
  const release = 0.16, stop = time + seconds + release;
  envelope.gain.setValueAtTime(0, time);
  envelope.gain.linearRampToValueAtTime(loud, time + Math.min(0.008, seconds / 2));
  envelope.gain.setTargetAtTime(loud * 0.35, time + Math.min(0.008, seconds / 2), 0.45);
  envelope.gain.setTargetAtTime(0, time + seconds, release / 4);
  filter.connect(envelope);
  let output = envelope;
  if (curvesOf[note[VOICE]] && context.createStereoPanner) {
    output = context.createStereoPanner();
    eachPoint(note, 10, time, (value, at) => output.pan.setValueAtTime(placeOf(value), at));
    envelope.connect(output);
  }
  output.connect(master);
  const voice = {envelope, oscillators: []};
  for (const [type, times, part] of [["triangle", 1, 1], ["sine", 2, 0.22]]) {
    const oscillator = context.createOscillator(), gain = context.createGain();
    oscillator.type = type; oscillator.frequency.value = frequency * times; gain.gain.value = part;
    eachPoint(note, -1, time, (value, at) => oscillator.detune.setValueAtTime(100 * value, at));
    if (note[SEMITONES]) slide(note, time, oscillator.detune);
    oscillator.connect(gain); gain.connect(filter);
    oscillator.start(time); oscillator.stop(stop);
    voice.oscillators.push(oscillator);
  }
  live.add(voice);
  voice.oscillators[0].onended = () => { live.delete(voice); envelope.disconnect(); output.disconnect(); };
}

function silence() {
  if (!sound) { live.clear(); return; }
  const now = sound.context.currentTime;
  for (const voice of live) {
    voice.envelope.gain.cancelScheduledValues(now);
    voice.envelope.gain.setTargetAtTime(0, now, 0.012);
    for (const oscillator of voice.oscillators) oscillator.stop(now + 0.08);
  }
  live.clear();
}

/* Notes count as sounded when their time has come, not when they are handed over ahead of it. */
function settle() {
  const now = clock();
  let count = 0;
  while (count < pending.length && pending[count].time <= now) recent.push(pending[count++].index);
  if (count === 0) return;
  sounded += count;
  pending = pending.slice(count);
  if (recent.length > 1000) recent = recent.slice(-1000);
}

function ahead() {
  settle();
  const now = clock();
  if (tickAt(now) >= end && !(loop && anchorTick < loop.to)) { stop(); anchorTick = end; draw(); return; }
  if (past && now >= anchorTime) past = null;
  /* A hidden page is called once a second only. */
  const horizon = now + (document.hidden ? 1.6 : 0.14);
  for (;;) {
    const last = loop && anchorTick < loop.to ? loop.to : Infinity;
    const until = uneven(even(anchorTick) + (horizon - anchorTime) * ticksPerSecond());
    for (; next < notes.length && notes[next][ONSET] <= until && notes[next][ONSET] < last; ++next) {
      const note = notes[next], time = Math.max(now, timeAt(note[ONSET]));
      strike(note, time, lasting(note[ONSET], Math.min(last, note[ONSET] + note[DURATION])));
      pending.push({index: next, time});
    }
    if (until < last) return;
    /* The loop begins anew when its last bar ends, without a gap. */
    const time = timeAt(last);
    if (!past) past = [anchorTick, anchorTime];
    anchorTick = loop.from; anchorTime = time;
    enter(last);
  }
}

/* Starts at the anchor, with the notes that already sound there. */
function enter(last) {
  next = firstFrom(anchorTick);
  eachWithin(anchorTick, anchorTick + 1, note => {
    if (note[ONSET] < anchorTick) {
      strike(note, anchorTime, lasting(anchorTick, Math.min(last, note[ONSET] + note[DURATION])));
    }
  });
}

function begin() {
  past = null;
  anchorTime = clock() + 0.03;
  enter(loop && anchorTick < loop.to ? loop.to : Infinity);
  ahead();
}

function stop() {
  const tick = Math.min(end, tickAt(clock()));
  settle();
  past = null;
  playing = false;
  pending = [];
  anchorTick = tick;
  clearInterval(timer);
  silence();
  label();
}

async function play() {
  openSound();
  if (sound && sound.context.state !== "running") {
    /* Without a device this may never come; then the curve is drawn in silence. */
    const ready = sound.context.resume();
    await Promise.race([ready.catch(() => {}), new Promise(done => setTimeout(done, 800))]);
    if (sound && sound.context.state !== "running") sound = null;
  }
  if (playing) return;
  if (anchorTick >= end) anchorTick = 0;
  if (loop && (anchorTick < loop.from || anchorTick >= loop.to)) anchorTick = loop.from;
  playing = true;
  begin();
  timer = setInterval(ahead, 25);
  label();
  requestAnimationFrame(frame);
}

function toggle() { if (playing) { stop(); draw(); } else play(); }

function seek(tick) {
  settle();
  pending = [];
  if (playing) silence();
  anchorTick = Math.min(end, Math.max(0, tick));
  if (playing) begin();
  draw();
}

/* To the beginning of the phrase, or of the one before if that has just been passed; or to the next. */
function seekPhrase(isBack) {
  const tick = tickAt(clock()), passed = playing ? data.quarter : 0;
  const i = isBack ? firstPhraseFrom(tick - passed) - 1 : firstPhraseFrom(tick + 1);
  if (isBack || i < phrases.length) seek(i < 0 ? 0 : phrases[i]);
}

function setTempo(value) {
  const tick = tickAt(clock()), isAhead = past !== null;
  settle();
  past = null;
  anchorTick = tick; anchorTime = clock();
  speed = value;
  /* Scheduled notes keep their time, except those of the next pass of the loop. */
  if (isAhead && playing) { silence(); begin(); }
  label();
}

/* Schedules anew what sounds, after a change of parts or loop. */
function playOn() {
  if (!playing) return;
  anchorTick = tickAt(clock());
  settle();
  pending = [];
  silence();
  begin();
}
function setLoop(from, to) {
  const bars = Math.max(1, Math.ceil(barAt(end)));
  const first = Math.min(Math.max(1, Math.round(from) || 1), bars);
  const last = Math.min(Math.max(first, Math.round(to) || first), bars);
  loop = {from: first === 1 ? 0 : tickOf(first - 1), to: Math.min(tickOf(last), end)};
  loopFrom.value = first; loopTo.value = last;
  loopButton.setAttribute("aria-pressed", "true");
  if (playing) {
    const tick = tickAt(clock());
    if (tick < loop.from || tick >= loop.to) seek(loop.from); else playOn();
  }
  draw();
}
function endLoop() {
  if (!loop) return;
  loop = null;
  loopButton.setAttribute("aria-pressed", "false");
  playOn();
  draw();
}
function toggleOf(set, part, isOn) {
  if (isOn) set.add(part); else set.delete(part);
  showParts();
  playOn();
  draw();
}

/* What is seen. */
const curve = element("curve"), curveTop = element("curve-top"), roll = element("roll");
const style = getComputedStyle(document.documentElement);
const dark = matchMedia("(prefers-color-scheme: dark)");
let colours = [], theme = {}, isByPart = false;
const partInks = [["#0b62a8", "#c2410c", "#047857", "#a21caf", "#8a6100", "#0e7490", "#6d28d9", "#52525b"],
                  ["#6cb8ff", "#ff9c66", "#4fd6a5", "#f19bf5", "#e8c255", "#6fd8ea", "#b9a5ff", "#c3c3cc"]];
const partColour = part => partInks[dark.matches ? 1 : 0][part % 8];
function readTheme() {
  const ramp = dark.matches ? data.screen : data.paper;
  colours = notes.map(note => {
    if (isByPart) return partColour(partOf(note));
    const at = (high > low ? (note[KEY] - low) / (high - low) : 0.5) * (ramp.length - 1);
    const below = Math.min(Math.floor(at), ramp.length - 2), part = at - below;
    const mixed = [0, 2, 4].map(i => {
      const a = parseInt(ramp[below].substr(i, 2), 16), b = parseInt(ramp[below + 1].substr(i, 2), 16);
      return Math.floor(a * (1 - part) + b * part + 0.5).toString(16).padStart(2, "0");
    });
    return "#" + mixed.join("");
  });
  for (const name of ["line", "stripe", "ghost", "faint", "mark", "panel", "accent"]) {
    theme[name] = style.getPropertyValue("--" + name).trim();
  }
}

let view = {step: 1, x: 0, y: 0, width: 1}, drawn = 0, drawnTick = -1;
function fit(canvas) {
  const box = canvas.parentElement.getBoundingClientRect(), ratio = Math.min(window.devicePixelRatio || 1, 3);
  canvas.width = Math.max(1, Math.round(box.width * ratio));
  canvas.height = Math.max(1, Math.round(box.height * ratio));
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return {context, width: box.width, height: box.height};
}
let curvePane, topPane, rollPane;
function layout() {
  readTheme();
  if (hasCurve) {
    curvePane = fit(curve); topPane = fit(curveTop);
    const room = 26, w = right - left, h = top_ - bottom;
    view.step = Math.min(w > 0 ? (curvePane.width - 2 * room) / w : Infinity,
                         h > 0 ? (curvePane.height - 2 * room) / h : Infinity);
    view.x = curvePane.width / 2 - view.step * (left + right) / 2;
    view.y = curvePane.height / 2 + view.step * (bottom + top_) / 2;
    view.width = Math.min(9, Math.max(0.9, view.step * 0.3));
  }
  rollPane = fit(roll);
  drawnTick = -1;
  draw();
}
const across = x => view.x + view.step * x, down = y => view.y - view.step * y;

function line(context, note, part) {
  const x0 = across(note[X0]), y0 = down(note[Y0]);
  context.beginPath();
  context.moveTo(x0, y0);
  const level = levelPart(note), run = level > 0 ? Math.min(1, part / level) : 1;
  context.lineTo(x0 + (across(note[X1]) - x0) * run, y0 + (down(note[Y1]) - y0) * run);
  if (part > level) context.lineTo(across(note[X1]), pointAt(note, part)[1]);
  context.stroke();
}
/* The part of a note before it slides. */
const levelPart = note => 1 - (note[GLIDE] || 0) / note[DURATION];
/* The place on the canvas where a note is after a part of its duration. */
function pointAt(note, part) {
  const level = levelPart(note), run = level > 0 ? Math.min(1, part / level) : 1;
  const risen = part > level ? (note[RISE] || 0) * (part - level) / (1 - level) : 0;
  return [across(note[X0] + (note[X1] - note[X0]) * run), down(note[Y0] + (note[Y1] - note[Y0]) * run + risen)];
}
const endY = note => note[Y1] + (note[RISE] || 0);

/* The silent run of the curve that leads to a note, if one does: parallel to an axis, else it is a jump. */
const before = [];
{
  const last = [];
  notes.forEach((note, i) => {
    const old = last[note[VOICE]];
    const aside = old && Math.abs(note[X0] - old[X1]) > 1e-6, up = old && Math.abs(note[Y0] - endY(old)) > 1e-6;
    before[i] = old && aside !== up ? [old[X1], endY(old), note[X0], note[Y0]] : null;
    last[note[VOICE]] = note;
  });
}

/* All of the curve, faintly. */
function ghost() {
  const {context, width, height} = curvePane;
  context.clearRect(0, 0, width, height);
  context.lineCap = "round"; context.lineJoin = "round";
  context.strokeStyle = theme.ghost;
  context.lineWidth = Math.max(0.6, view.width * 0.4);
  context.beginPath();
  notes.forEach((note, i) => {
    for (const [x0, y0, x1, y1] of before[i] ? [before[i], note.slice(X0)] : [note.slice(X0)]) {
      context.moveTo(across(x0), down(y0));
      context.lineTo(across(x1), down(y1));
    }
    if (note[RISE]) context.lineTo(across(note[X1]), down(endY(note)));
  });
  context.stroke();
  drawn = 0;
}

/* The coloured part grows with time; going back draws it anew. Notes that still sound are drawn in part, above. */
const begun = new Set();
function drawCurve(tick) {
  if (!hasCurve) return;
  if (drawnTick < 0 || tick < drawnTick) { ghost(); begun.clear(); }
  drawnTick = tick;
  const under = curvePane.context, over = topPane.context;
  for (const until = firstFrom(tick); drawn < until; ++drawn) {
    begun.add(drawn);
    if (!before[drawn]) continue;
    const [x0, y0, x1, y1] = before[drawn];
    under.strokeStyle = theme.faint;
    under.lineWidth = Math.max(0.6, view.width * 0.25);
    under.beginPath();
    under.moveTo(across(x0), down(y0)); under.lineTo(across(x1), down(y1));
    under.stroke();
  }
  over.clearRect(0, 0, topPane.width, topPane.height);
  over.lineCap = "round";
  under.lineWidth = over.lineWidth = view.width;
  for (const i of begun) {
    const note = notes[i];
    if (note[ONSET] + note[DURATION] <= tick) {
      under.strokeStyle = colours[i];
      line(under, note, 1);
      begun.delete(i);
    } else {
      over.strokeStyle = colours[i];
      line(over, note, (tick - note[ONSET]) / note[DURATION]);
    }
  }
  if (tick <= 0 || tick >= end) return;
  for (const i of begun) {
    const note = notes[i], part = (tick - note[ONSET]) / note[DURATION];
    const [x, y] = pointAt(note, part);
    over.beginPath();
    over.arc(x, y, Math.max(5, view.width * 0.9), 0, 2 * Math.PI);
    over.fillStyle = colours[i]; over.fill();
    over.lineWidth = 2; over.strokeStyle = theme.mark; over.stroke();
  }
}

/* The roll shows all of a short score; else 8 bars, and moves along. */
const shownTicks = end <= tickOf(16) ? end : tickOf(8);
let lowest = Math.floor(low) - 1, highest = Math.ceil(high) + 1;
if (notes.length === 0) { lowest = 55; highest = 67; }
while (highest - lowest < 12) { --lowest; if (highest - lowest < 12) ++highest; }
const keysWidth = 38, barsHeight = 22;
let rollFrom = 0;
const black = [1, 3, 6, 8, 10];
const modulo = (a, b) => ((a % b) + b) % b;
function drawRoll(tick) {
  const {context, width, height} = rollPane;
  const w = width - keysWidth - 10, h = height - barsHeight - 12, row = h / (highest - lowest + 1);
  rollFrom = Math.min(Math.max(0, tick - shownTicks * 0.35), end - shownTicks);
  const x = t => keysWidth + (t - rollFrom) / shownTicks * w, y = key => 12 + h - row * (key - lowest + 0.5);
  context.clearRect(0, 0, width, height);
  context.font = "12px system-ui, sans-serif";
  context.textBaseline = "middle";
  for (let key = lowest; key <= highest; ++key) {
    if (black.includes(modulo(key, 12))) {
      context.fillStyle = theme.stripe;
      context.fillRect(keysWidth, y(key) - row / 2, w, row);
    }
  }
  context.lineWidth = 1;
  context.strokeStyle = theme.line;
  context.beginPath();
  const barWidth = Math.min(...spans.map(one => one.length)) / shownTicks * w;
  let every = 1;
  while (barWidth * every < 7) every *= 2;
  let named = every;
  while (barWidth * named < 44) named *= 2;
  context.fillStyle = theme.faint; context.textAlign = "left";
  for (let i = Math.ceil(barAt(rollFrom) / every) * every; tickOf(i) <= rollFrom + shownTicks; i += every) {
    const tick = tickOf(i);
    context.moveTo(x(tick), 12); context.lineTo(x(tick), 12 + h);
    if (i % named === 0 && tick < end && x(tick) < width - 30) context.fillText(i + 1, x(tick) + 3, height - barsHeight / 2 - 1);
  }
  context.stroke();
  context.textAlign = "right";
  context.strokeStyle = theme.faint; context.globalAlpha = 0.45;
  for (let key = lowest; key <= highest; ++key) {
    if (modulo(key, 12) !== 0) continue;
    context.beginPath();
    context.moveTo(keysWidth, y(key) + row / 2); context.lineTo(keysWidth + w, y(key) + row / 2);
    context.stroke();
    context.globalAlpha = 1;
    context.fillText("C" + (key / 12 - 1), keysWidth - 7, y(key));
    context.globalAlpha = 0.45;
  }
  context.globalAlpha = 1;
  context.save();
  context.beginPath(); context.rect(keysWidth, 0, w + 1, height); context.clip();
  const thick = Math.max(2, row * 0.84);
  eachWithin(rollFrom, rollFrom + shownTicks, (note, i) => {
    const slides = note[GLIDE] || 0;
    const from = x(note[ONSET]), full = (note[DURATION] - slides) / shownTicks * w;
    const long = Math.max(1, full > 3 ? full - 1.2 : full * 0.8);
    const now = note[ONSET] <= tick && note[ONSET] + note[DURATION] > tick && tick > 0;
    context.globalAlpha = !isHeard(note) ? 0.12 : now || note[ONSET] + note[DURATION] <= tick ? 1 : 0.42;
    context.fillStyle = colours[i];
    context.beginPath();
    if (context.roundRect) context.roundRect(from, y(note[KEY]) - thick / 2, long, thick, Math.min(3, long / 3, thick / 3));
    else context.rect(from, y(note[KEY]) - thick / 2, long, thick);
    context.fill();
    if (now) { context.strokeStyle = theme.mark; context.lineWidth = 1.5; context.stroke(); }
    if (slides) {
      const end = note[ONSET] + note[DURATION];
      context.strokeStyle = colours[i]; context.lineWidth = Math.max(1.5, thick / 2);
      context.beginPath();
      context.moveTo(x(end - slides), y(note[KEY])); context.lineTo(x(end), y(note[KEY] + note[SEMITONES]));
      context.stroke();
    }
  });
  context.globalAlpha = 1;
  context.fillStyle = theme.accent;
  const lastPhrase = firstPhraseFrom(rollFrom + shownTicks);
  for (let i = firstPhraseFrom(rollFrom); i < lastPhrase; ++i) {
    const at = x(phrases[i]);
    context.beginPath();
    context.moveTo(at - 5, 1); context.lineTo(at + 5, 1); context.lineTo(at, 10);
    context.fill();
  }
  if (loop) {
    context.fillStyle = theme.accent; context.globalAlpha = 0.1;
    context.fillRect(x(loop.from), 6, x(loop.to) - x(loop.from), h + 10);
    context.globalAlpha = 1;
    for (const edge of [loop.from, loop.to]) context.fillRect(x(edge) - 1, 6, 2, h + 10);
  }
  context.strokeStyle = theme.mark; context.lineWidth = 1.5;
  context.beginPath(); context.moveTo(x(tick), 6); context.lineTo(x(tick), 12 + h + 4); context.stroke();
  context.restore();
}

function seconds(ticks) {
  const s = Math.floor(even(ticks) / ticksPerSecond() + 1e-6);
  return Math.floor(s / 60) + ":" + String(s % 60).padStart(2, "0");
}
let shownText = "";
function label() {
  button.querySelector("span").textContent = playing ? "Pause" : "Play";
  button.querySelector("path").setAttribute("d", playing ? "M1 0h3v10H1zM6 0h3v10H6z" : "M1 0l8 5-8 5z");
  element("tempo-text").textContent = Math.round(speed * 100) / 100;
  shownText = "";
}
function draw() {
  const tick = shownTick();
  drawCurve(tick);
  drawRoll(tick);
  const bars = Math.max(1, Math.ceil(barAt(end))), here = Math.min(bars, Math.floor(barAt(tick)) + 1);
  const text = seconds(tick) + " / " + seconds(end);
  if (document.activeElement !== place || !dragging) place.value = tick / end * 1000;
  if (text + here !== shownText) {
    shownText = text + here;
    element("place-text").textContent = text;
    // While the music plays, a screen reader would read every change aloud.
    if (!playing || dragging) {
      place.setAttribute("aria-valuetext", "bar " + here + " of " + bars + ", " + seconds(tick));
    }
  }
}
function frame() {
  if (!playing) return;
  settle();
  draw();
  requestAnimationFrame(frame);
}

/* The parts, each with its colour, mute and solo. */
const partRows = [];
function showParts() {
  parts.forEach((unused, part) => {
    const {swatch, mute, solo} = partRows[part];
    swatch.style.background = isByPart ? partColour(part) : "transparent";
    mute.setAttribute("aria-pressed", String(muted.has(part)));
    solo.setAttribute("aria-pressed", String(alone.has(part)));
  });
}
function smallButton(text, name, act) {
  const made = document.createElement("button");
  made.type = "button"; made.className = "small"; made.textContent = text;
  made.setAttribute("aria-label", name); made.setAttribute("aria-pressed", "false"); made.title = name;
  made.addEventListener("click", () => act(made.getAttribute("aria-pressed") !== "true"));
  return made;
}
if (parts.length > 1) {
  const box = element("parts");
  box.hidden = false;
  parts.forEach(([name], part) => {
    const row = document.createElement("span"), swatch = document.createElement("i");
    row.className = "part";
    const mute = smallButton("M", "Mute " + name, isOn => toggleOf(muted, part, isOn));
    const solo = smallButton("S", "Solo " + name, isOn => toggleOf(alone, part, isOn));
    row.append(swatch, name, mute, solo);
    box.append(row);
    partRows.push({swatch, mute, solo});
  });
  const colour = smallButton("Colour by part", "Colour by part", isOn => {
    isByPart = isOn;
    colour.setAttribute("aria-pressed", String(isOn));
    showParts();
    layout();
  });
  box.append(colour);
}
const loopButton = element("loop"), loopFrom = element("loop-from"), loopTo = element("loop-to");
loopFrom.max = loopTo.max = loopTo.value = Math.max(1, Math.ceil(barAt(end)));
loopButton.addEventListener("click", () => loop ? endLoop() : setLoop(Number(loopFrom.value), Number(loopTo.value)));
for (const input of [loopFrom, loopTo]) {
  input.addEventListener("change", () => { if (loop) setLoop(Number(loopFrom.value), Number(loopTo.value)); });
}

if (phrases.length > 1) {
  for (const id of ["phrases", "phrase-hint"]) element(id).hidden = false;
  element("phrase-before").addEventListener("click", () => seekPhrase(true));
  element("phrase-after").addEventListener("click", () => seekPhrase(false));
  /* The slider has ticks at phrases unless they would merge. */
  for (const tick of phrases.length <= 64 ? phrases : []) {
    const option = document.createElement("option");
    option.value = tick / end * 1000;
    element("phrase-begins").append(option);
  }
}

let dragging = false;
button.addEventListener("click", toggle);
tempo.addEventListener("input", () => setTempo(Number(tempo.value)));
place.addEventListener("pointerdown", () => { dragging = true; });
addEventListener("pointerup", () => { dragging = false; });
place.addEventListener("input", () => seek(Number(place.value) / 1000 * end));
function seekTo(event) {
  const box = roll.getBoundingClientRect();
  const part = (event.clientX - box.left - keysWidth) / (box.width - keysWidth - 10);
  const tick = rollFrom + Math.min(1, Math.max(0, part)) * shownTicks;
  /* A click on the mark of a phrase goes to its first note. */
  const near = 8 / (box.width - keysWidth - 10) * shownTicks;
  const phrase = event.clientY - box.top < 12 ? phrases[firstPhraseFrom(tick - near)] : undefined;
  seek(phrase <= tick + near ? phrase : tick);
}
roll.addEventListener("pointerdown", event => { if (event.button === 0) seekTo(event); });
document.addEventListener("keydown", event => {
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  const target = event.target;
  if (event.key === " ") {
    /* A button or a summary under the focus has its own use for it. */
    if (target.closest("button, summary")) return;
    event.preventDefault();
    if (!event.repeat) toggle();
  } else if (target.closest("input, pre")) {
    return;
  } else if (event.shiftKey && (event.key === "ArrowLeft" || event.key === "ArrowRight")) {
    seekPhrase(event.key === "ArrowLeft");
  } else if (event.key === "ArrowLeft") {
    seek(Math.max(0, tickOf(barAt(tickAt(clock())) - 1)));
  } else if (event.key === "ArrowRight") {
    seek(tickOf(barAt(tickAt(clock())) + 1));
  } else if (event.key === "Home") {
    seek(0);
  } else if (event.key === "l" || event.key === "L") {
    if (loop) endLoop(); else setLoop(Number(loopFrom.value), Number(loopTo.value));
  } else if (event.key === "[" || event.key === "]") {
    /* The loop begins or ends with the bar that is played. */
    const here = Math.floor(barAt(Math.min(tickAt(clock()), end - 1))) + 1;
    if (event.key === "[") setLoop(here, Math.max(here, Number(loopTo.value)));
    else setLoop(Math.min(here, Number(loopFrom.value)), here);
  }
});
dark.addEventListener("change", () => { layout(); if (parts.length > 1) showParts(); });
new ResizeObserver(layout).observe(element("panels"));
tempo.value = speed;
label();
layout();

window.sikku = {
  notes,
  state() {
    settle();
    const time = clock();
    return {playing, time, tick: Math.min(end, tickAt(time)), tempo: speed, sounded, recent: recent.slice(),
            loop: loop && [loop.from, loop.to], muted: [...muted], alone: [...alone], voices: live.size};
  },
  play, pause() { if (playing) { stop(); draw(); } }, seek, colour: index => colours[index]
};
