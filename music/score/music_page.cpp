#include "music/score/music_page.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>

namespace sikku {
namespace {

// ---- texts and numbers

/// At most `places` decimals, no zeros at the end, no -0.
void put(std::string& out, double value, int places) {
    const std::size_t begin = out.size();
    fmt::format_to(std::back_inserter(out), "{:.{}f}", value, places);
    if (out.find('.', begin) != std::string::npos) {
        while (out.back() == '0') out.pop_back();
        if (out.back() == '.') out.pop_back();
    }
    if (std::string_view(out).substr(begin) == "-0") out.erase(begin, 1);
}

std::string number(double value, int places = 3) {
    std::string result;
    put(result, value, places);
    return result;
}

/// Characters, not bytes.
std::string shortened(std::string_view text, std::size_t most) {
    std::size_t bytes = 0;
    for (std::size_t count = 0; bytes < text.size(); ++count) {
        if (count == most) return std::string(text.substr(0, bytes)) + "…";
        bytes += std::max<std::size_t>(1, utf8_length(text.substr(bytes)));
    }
    return std::string(text);
}

/// Hands its text on in pieces.
class Pieces {
public:
    explicit Pieces(Output& out) : out_(out) {}
    std::string& text() {
        if (text_.size() >= flush_bytes) flush();
        return text_;
    }
    void flush() {
        out_.write(text_);
        text_.clear();
    }

private:
    static constexpr std::size_t flush_bytes = std::size_t{1} << 16;
    Output& out_;
    std::string text_;
};

// ---- colours

/// From the lowest key to the highest, evenly lighter (OKLCH): L 0.40 to 0.72 for paper, 0.62 to 0.90 for a dark
/// screen, the hue from blue over red to yellow. So the order can be seen in grey and by those who tell no colours.
constexpr std::array<std::string_view, 9> paper_ramp = {"243b9c", "5338a8", "7a36a8", "9e359c", "bd3885",
                                                        "d44469", "e25949", "e57529", "df911a"};
constexpr std::array<std::string_view, 9> screen_ramp = {"4e82e5", "887ef2", "b97aed", "e378d9", "ff80b9",
                                                         "fe9ca2", "feb298", "fec694", "ffd988"};

int channel(std::string_view colour, std::size_t which) {
    const auto digit = [&](std::size_t i) {
        const char c = colour[i];
        return c <= '9' ? c - '0' : c - 'a' + 10;
    };
    return 16 * digit(2 * which) + digit(2 * which + 1);
}

/// `#rrggbb` of a ramp at 0 to 1.
std::string ramp_colour(const std::array<std::string_view, 9>& ramp, double at) {
    const double scaled = std::clamp(at, 0.0, 1.0) * static_cast<double>(ramp.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(scaled), ramp.size() - 2);
    const double part = scaled - static_cast<double>(below);
    std::string result = "#";
    for (std::size_t i = 0; i < 3; ++i) {
        const double value = channel(ramp[below], i) * (1.0 - part) + channel(ramp[below + 1], i) * part;
        fmt::format_to(std::back_inserter(result), "{:02x}", static_cast<int>(value + 0.5));
    }
    return result;
}

// ---- what both writers look at

struct Melody {
    std::vector<Note> notes;  ///< by onset, then by voice
    std::int64_t end = 1;     ///< above 0
    double low = 60.0;        ///< keys
    double high = 60.0;
    glm::dvec2 curve_low{0.0};  ///< turtle steps
    glm::dvec2 curve_high{0.0};

    bool has_curve() const { return curve_low != curve_high; }
    /// 0 for the lowest key, 1 for the highest.
    double height(double key) const { return high > low ? (key - low) / (high - low) : 0.5; }
};

Melody survey(const std::vector<Note>& notes, std::int64_t end) {
    Melody melody;
    melody.notes = notes;
    std::stable_sort(melody.notes.begin(), melody.notes.end(), [](const Note& a, const Note& b) {
        return std::tie(a.onset, a.voice) < std::tie(b.onset, b.voice);
    });
    melody.end = std::max<std::int64_t>(end, 1);
    if (notes.empty()) return melody;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    melody.low = infinity;
    melody.high = -infinity;
    melody.curve_low = glm::dvec2(infinity);
    melody.curve_high = glm::dvec2(-infinity);
    for (const Note& note : melody.notes) {
        melody.end = std::max(melody.end, note.onset + note.duration);
        melody.low = std::min(melody.low, note.key);
        melody.high = std::max(melody.high, note.key);
        for (const glm::dvec2 point : {note.from, note.to}) {
            melody.curve_low = {std::min(melody.curve_low.x, point.x), std::min(melody.curve_low.y, point.y)};
            melody.curve_high = {std::max(melody.curve_high.x, point.x), std::max(melody.curve_high.y, point.y)};
        }
    }
    return melody;
}

/// A silent piece of the curve between two notes of a voice.
struct Joint {
    glm::dvec2 from{0.0};
    glm::dvec2 to{0.0};
};

/// Only what is parallel to an axis is a run of the curve; a slanting gap is a jump, as after a bracket.
std::vector<Joint> joints(const Melody& melody) {
    constexpr double nothing = 1e-6;
    std::vector<Joint> result;
    std::vector<const Note*> last;
    for (const Note& note : melody.notes) {
        const auto voice = static_cast<std::size_t>(std::max<int>(note.voice, 0));
        if (voice >= last.size()) last.resize(voice + 1, nullptr);
        if (const Note* before = last[voice]) {
            const bool across = std::abs(note.from.x - before->to.x) > nothing;
            const bool up = std::abs(note.from.y - before->to.y) > nothing;
            if (across != up) result.push_back({before->to, note.from});
        }
        last[voice] = &note;
    }
    return result;
}

/// Tempo, metre, parts in words.
std::string subtitle(const ScoreHead& head, const Melody& melody) {
    std::string text = fmt::format("{} {}, {} quarters a minute, {}/{}", melody.notes.size(),
                                   melody.notes.size() == 1 ? "note" : "notes", number(head.tempo, 2),
                                   head.meter.beats, head.meter.unit);
    for (const Part& part : head.parts) text += fmt::format(" · {}, {}", part.name, part.scale);
    return head.composer.empty() ? text : fmt::format("{} · {}", shortened(head.composer, 90), text);
}

std::string title_of(const ScoreHead& head) {
    return head.title.empty() ? "A melody" : head.title;
}

bool is_black(int key) {
    constexpr std::array<bool, 12> black = {false, true,  false, true,  false, false,
                                            true,  false, true,  false, true,  false};
    return black[static_cast<std::size_t>(((key % 12) + 12) % 12)];
}

// ---- SVG

struct Panel {
    double left = 0.0;
    double top = 0.0;
    double width = 0.0;
    double height = 0.0;
};

// Millimetres.
constexpr double page_width = 297.0;
constexpr double page_height = 210.0;
constexpr double page_margin = 14.0;
constexpr double panels_top = 34.0;
constexpr double panels_bottom = page_height - 20.0;
constexpr double key_names_width = 8.0;
constexpr double between_panels = 10.0;

void write_curve(const Melody& melody, const Panel& panel, Pieces& out) {
    const glm::dvec2 extent = melody.curve_high - melody.curve_low;
    const double room = 1.2;  // for the strokes' width
    const double step = std::min(extent.x > 0.0 ? (panel.width - room) / extent.x : panel.height,
                                 extent.y > 0.0 ? (panel.height - room) / extent.y : panel.height);
    const glm::dvec2 centre = 0.5 * (melody.curve_low + melody.curve_high);
    const auto place = [&](glm::dvec2 point) {
        return glm::dvec2(panel.left + 0.5 * panel.width + step * (point.x - centre.x),
                          panel.top + 0.5 * panel.height - step * (point.y - centre.y));
    };
    const double width = std::clamp(0.28 * step, 0.08, 1.2);
    const std::vector<Joint> gaps = joints(melody);
    out.text() +=
        fmt::format("<g id=\"curve\" fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{}\">\n", number(width));
    // In several paths, as readers refuse very long attributes.
    constexpr std::size_t joints_of_a_path = 1000;
    for (std::size_t i = 0; i < gaps.size(); i += joints_of_a_path) {
        out.text() += fmt::format("<path class=\"silent\" stroke=\"#9a9aa5\" stroke-width=\"{}\" d=\"",
                                  number(std::max(0.3 * width, 0.05)));
        for (std::size_t k = i; k < std::min(i + joints_of_a_path, gaps.size()); ++k) {
            const glm::dvec2 from = place(gaps[k].from);
            const glm::dvec2 to = place(gaps[k].to);
            out.text() += fmt::format("M{} {}L{} {}", number(from.x), number(from.y), number(to.x), number(to.y));
        }
        out.text() += "\"/>\n";
    }
    for (const Note& note : melody.notes) {
        const glm::dvec2 from = place(note.from);
        const glm::dvec2 to = place(note.to);
        out.text() += fmt::format("<line stroke=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n",
                                  ramp_colour(paper_ramp, melody.height(note.key)), number(from.x), number(from.y),
                                  number(to.x), number(to.y));
    }
    out.text() += "</g>\n";
}

void write_roll(const ScoreHead& head, const Melody& melody, const Panel& panel, Pieces& out) {
    // At least an octave high, so that three notes are no three boards.
    int low = static_cast<int>(std::floor(melody.low)) - 1;
    int high = static_cast<int>(std::ceil(melody.high)) + 1;
    while (high - low < 12) {
        --low;
        if (high - low < 12) ++high;
    }
    const double row = panel.height / (high - low + 1);
    const double width_of_tick = panel.width / static_cast<double>(melody.end);
    const auto across = [&](std::int64_t tick) { return panel.left + width_of_tick * static_cast<double>(tick); };
    const auto middle = [&](double key) { return panel.top + panel.height - row * (key - low + 0.5); };
    const double bottom = panel.top + panel.height;

    out.text() += "<g id=\"keys\">\n";
    out.text() += fmt::format("<rect fill=\"#fafafc\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
                              number(panel.left), number(panel.top), number(panel.width), number(panel.height));
    for (int key = low; key <= high; ++key) {
        if (!is_black(key)) continue;
        out.text() +=
            fmt::format("<rect fill=\"#f0f0f4\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", number(panel.left),
                        number(middle(key) - 0.5 * row), number(panel.width), number(row));
    }
    for (int key = low; key <= high; ++key) {
        if (((key % 12) + 12) % 12 != 0) continue;
        const double line = middle(key) + 0.5 * row;
        out.text() += fmt::format(
            "<path class=\"octave\" stroke=\"#b9b9c4\" stroke-width=\"0.15\" d=\"M{} {}h{}\"/>\n"
            "<text fill=\"#5c5c68\" font-size=\"2.8\" text-anchor=\"end\" x=\"{}\" y=\"{}\">C{}</text>\n",
            number(panel.left), number(line), number(panel.width), number(panel.left - 1.2),
            number(middle(key) + 1.0), (key + 120) / 12 - 11);
    }
    out.text() += "</g>\n<g id=\"bars\">\n";
    // Every bar, or every 2nd, 4th, 8th where that would be a grey field; a number at most every 12 mm.
    const auto bar = static_cast<double>(std::max<std::int64_t>(head.meter.bar(), 1)) * width_of_tick;
    std::int64_t every = 1;
    while (bar * static_cast<double>(every) < 3.0) every *= 2;
    std::int64_t named = every;
    while (bar * static_cast<double>(named) < 12.0) named *= 2;
    const std::int64_t ticks = std::max<std::int64_t>(head.meter.bar(), 1);
    for (std::int64_t i = 0; i <= melody.end / ticks; i += every) {
        out.text() += fmt::format("<path class=\"bar\" stroke=\"#cfcfd8\" stroke-width=\"0.12\" d=\"M{} {}V{}\"/>\n",
                                  number(across(i * ticks)), number(panel.top), number(bottom));
        if (i % named == 0 && i * ticks < melody.end) {
            out.text() += fmt::format("<text fill=\"#5c5c68\" font-size=\"2.8\" x=\"{}\" y=\"{}\">{}</text>\n",
                                      number(across(i * ticks)), number(bottom + 4.0), i + 1);
        }
    }
    out.text() += "</g>\n<g id=\"roll\">\n";
    const double thick = std::max(0.86 * row, 0.6);
    for (const Note& note : melody.notes) {
        // A little is left out at the end, so that the same key twice is two notes.
        const double full = width_of_tick * static_cast<double>(note.duration);
        // Notes of a very long score hide each other rather than themselves.
        const double width = full > 0.6 ? full - 0.2 : std::max(full * 0.7, 0.35);
        out.text() += fmt::format("<rect fill=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\"/>\n",
                                  ramp_colour(paper_ramp, melody.height(note.key)), number(across(note.onset)),
                                  number(middle(note.key) - 0.5 * thick), number(width), number(thick),
                                  number(std::min({0.4, 0.3 * thick, 0.3 * width})));
    }
    out.text() += "</g>\n";
}

// ---- the page

constexpr std::string_view page_style = R"css(
:root{color-scheme:light dark;--ground:#f6f5f2;--panel:#fff;--text:#22222a;--faint:#5f5f6b;--line:#dcdbe2;
--stripe:#f4f4f7;--ghost:#dddde5;--accent:#5338a8;--on-accent:#fff;--mark:#15151c}
@media(prefers-color-scheme:dark){:root{--ground:#121319;--panel:#191b23;--text:#ececf2;--faint:#a3a4b3;
--line:#31333f;--stripe:#1e2029;--ghost:#353846;--accent:#b9a7ff;--on-accent:#16121f;--mark:#fff}}
*{box-sizing:border-box}
html,body{margin:0;background:var(--ground);color:var(--text)}
body{font:16px/1.45 system-ui,"Segoe UI",Roboto,"DejaVu Sans",sans-serif;padding:clamp(12px,2.5vw,32px)}
main{max-width:1500px;margin:0 auto}
h1{font-size:clamp(1.3rem,2.6vw,2rem);line-height:1.2;margin:0;font-weight:650;overflow-wrap:anywhere}
.about{color:var(--faint);margin:.25rem 0 1rem;overflow-wrap:anywhere}
.bar{display:flex;flex-wrap:wrap;gap:.6rem 1.4rem;align-items:center;background:var(--panel);
border:1px solid var(--line);border-radius:14px;padding:.7rem 1rem;margin-bottom:1rem}
.bar label{display:flex;align-items:center;gap:.6rem;color:var(--faint);font-size:.9rem}
.bar .long{flex:1 1 16rem}
.bar .long input{flex:1 1 auto;min-width:6rem}
input[type=range]{accent-color:var(--accent);height:1.6rem}
output{color:var(--text);font-variant-numeric:tabular-nums;white-space:nowrap}
button{font:inherit;font-weight:600;min-width:7rem;padding:.55rem 1.1rem;border:0;border-radius:999px;
background:var(--accent);color:var(--on-accent);cursor:pointer}
button svg{width:.85em;height:.85em;margin-right:.5em;fill:currentColor}
:focus-visible{outline:3px solid var(--accent);outline-offset:2px}
.panels{display:grid;grid-template-columns:minmax(0,5fr) minmax(0,6fr);gap:1rem;height:clamp(300px,68vh,900px)}
.panels.flat{grid-template-columns:minmax(0,1fr)}
.panels.flat .curve{display:none}
figure{margin:0;position:relative;background:var(--panel);border:1px solid var(--line);border-radius:14px;
overflow:hidden;min-height:0}
figure canvas{position:absolute;inset:0;width:100%;height:100%;display:block}
.roll{cursor:pointer}
details{margin-top:1rem;color:var(--faint)}
summary{cursor:pointer;width:fit-content}
pre{color:var(--text);background:var(--panel);border:1px solid var(--line);border-radius:14px;padding:1rem;
overflow:auto;font:13px/1.5 ui-monospace,"DejaVu Sans Mono",monospace}
.hint{color:var(--faint);font-size:.85rem;margin:.8rem 0 0}
kbd{border:1px solid var(--line);border-radius:4px;padding:0 .35em;font:inherit;font-size:.92em}
@media(max-width:760px){.panels{grid-template-columns:minmax(0,1fr);grid-template-rows:1fr 1fr;height:auto}
figure{height:min(92vw,60vh)}}
)css";

constexpr std::string_view page_script = R"js(
"use strict";
const data = JSON.parse(document.getElementById("score").textContent);
const notes = data.notes, end = data.end, bar = data.bar;
const ONSET = 0, DURATION = 1, KEY = 2, VOICE = 3, VELOCITY = 4, X0 = 5, Y0 = 6, X1 = 7, Y1 = 8;
const element = id => document.getElementById(id);
const button = element("play"), tempo = element("tempo"), place = element("place");
let low = 127, high = 0, longest = 0;
let left = Infinity, right = -Infinity, bottom = Infinity, top_ = -Infinity;
for (const note of notes) {
  low = Math.min(low, note[KEY]); high = Math.max(high, note[KEY]);
  longest = Math.max(longest, note[DURATION]);
  left = Math.min(left, note[X0], note[X1]); right = Math.max(right, note[X0], note[X1]);
  bottom = Math.min(bottom, note[Y0], note[Y1]); top_ = Math.max(top_, note[Y0], note[Y1]);
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

/* Time: ticks against the clock of the sound, from an anchor that moves when tempo or place change. */
let sound = null, playing = false, anchorTick = 0, anchorTime = 0, next = 0, timer = 0;
let speed = data.tempo;
const live = new Set();
let pending = [];
let sounded = 0;
let recent = [];
const clock = () => sound ? sound.context.currentTime : performance.now() / 1000;
const ticksPerSecond = () => speed * data.quarter / 60;
const tickAt = time => Math.max(0, anchorTick + (playing ? (time - anchorTime) * ticksPerSecond() : 0));
const timeAt = tick => anchorTime + (tick - anchorTick) / ticksPerSecond();
/* What is heard now was handed over a moment ago. */
const latency = () => sound && playing ? Math.min(sound.context.outputLatency || 0, 0.5) : 0;
const shownTick = () => Math.min(end, Math.max(Math.min(anchorTick, end), tickAt(clock() - latency())));

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

/* A soft pluck: a triangle, an octave above it a quiet sine, and a filter that closes as the note fades. */
function strike(note, time, seconds) {
  if (!sound) return;
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
  filter.connect(envelope); envelope.connect(master);
  const voice = {envelope, oscillators: []};
  for (const [type, times, part] of [["triangle", 1, 1], ["sine", 2, 0.22]]) {
    const oscillator = context.createOscillator(), gain = context.createGain();
    oscillator.type = type; oscillator.frequency.value = frequency * times; gain.gain.value = part;
    oscillator.connect(gain); gain.connect(filter);
    oscillator.start(time); oscillator.stop(stop);
    voice.oscillators.push(oscillator);
  }
  live.add(voice);
  voice.oscillators[0].onended = () => { live.delete(voice); envelope.disconnect(); };
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
  if (tickAt(now) >= end) { stop(); anchorTick = end; draw(); return; }
  /* A hidden page is called once a second only. */
  const until = tickAt(now + (document.hidden ? 1.6 : 0.14));
  for (; next < notes.length && notes[next][ONSET] <= until; ++next) {
    const note = notes[next], time = Math.max(now, timeAt(note[ONSET]));
    strike(note, time, note[DURATION] / ticksPerSecond());
    pending.push({index: next, time});
  }
}

/* Begins to play at the anchor, in the midst of what sounds there. */
function begin() {
  anchorTime = clock() + 0.03;
  next = firstFrom(anchorTick);
  eachWithin(anchorTick, anchorTick + 1, note => {
    if (note[ONSET] < anchorTick) {
      strike(note, anchorTime, (note[ONSET] + note[DURATION] - anchorTick) / ticksPerSecond());
    }
  });
  ahead();
}

function stop() {
  const tick = Math.min(end, tickAt(clock()));
  settle();
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

function setTempo(value) {
  const tick = tickAt(clock());
  settle();
  anchorTick = tick; anchorTime = clock();
  speed = value;
  /* What was handed over and has not begun keeps its time. */
  label();
}

/* What is seen. */
const curve = element("curve"), curveTop = element("curve-top"), roll = element("roll");
const style = getComputedStyle(document.documentElement);
const dark = matchMedia("(prefers-color-scheme: dark)");
let colours = [], theme = {};
function readTheme() {
  const ramp = dark.matches ? data.screen : data.paper;
  colours = notes.map(note => {
    const at = (high > low ? (note[KEY] - low) / (high - low) : 0.5) * (ramp.length - 1);
    const below = Math.min(Math.floor(at), ramp.length - 2), part = at - below;
    const mixed = [0, 2, 4].map(i => {
      const a = parseInt(ramp[below].substr(i, 2), 16), b = parseInt(ramp[below + 1].substr(i, 2), 16);
      return Math.floor(a * (1 - part) + b * part + 0.5).toString(16).padStart(2, "0");
    });
    return "#" + mixed.join("");
  });
  for (const name of ["line", "stripe", "ghost", "faint", "mark", "panel"]) {
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
  context.lineTo(x0 + (across(note[X1]) - x0) * part, y0 + (down(note[Y1]) - y0) * part);
  context.stroke();
}

/* The silent run of the curve that leads to a note, if one does: parallel to an axis, else it is a jump. */
const before = [];
{
  const last = [];
  notes.forEach((note, i) => {
    const old = last[note[VOICE]];
    const aside = old && Math.abs(note[X0] - old[X1]) > 1e-6, up = old && Math.abs(note[Y0] - old[Y1]) > 1e-6;
    before[i] = old && aside !== up ? [old[X1], old[Y1], note[X0], note[Y0]] : null;
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
    const x = across(note[X0] + (note[X1] - note[X0]) * part), y = down(note[Y0] + (note[Y1] - note[Y0]) * part);
    over.beginPath();
    over.arc(x, y, Math.max(5, view.width * 0.9), 0, 2 * Math.PI);
    over.fillStyle = colours[i]; over.fill();
    over.lineWidth = 2; over.strokeStyle = theme.mark; over.stroke();
  }
}

/* The roll shows all of a short score; else 8 bars, and moves along. */
const shownTicks = end <= 16 * bar ? end : 8 * bar;
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
  const barWidth = bar / shownTicks * w;
  let every = 1;
  while (barWidth * every < 7) every *= 2;
  let named = every;
  while (barWidth * named < 44) named *= 2;
  context.fillStyle = theme.faint; context.textAlign = "left";
  for (let i = Math.ceil(rollFrom / bar / every) * every; i * bar <= rollFrom + shownTicks; i += every) {
    context.moveTo(x(i * bar), 12); context.lineTo(x(i * bar), 12 + h);
    if (i % named === 0 && i * bar < end && x(i * bar) < width - 30) context.fillText(i + 1, x(i * bar) + 3, height - barsHeight / 2 - 1);
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
    const from = x(note[ONSET]), full = note[DURATION] / shownTicks * w;
    const long = Math.max(1, full > 3 ? full - 1.2 : full * 0.8);
    const now = note[ONSET] <= tick && note[ONSET] + note[DURATION] > tick && tick > 0;
    context.globalAlpha = now || note[ONSET] + note[DURATION] <= tick ? 1 : 0.42;
    context.fillStyle = colours[i];
    context.beginPath();
    if (context.roundRect) context.roundRect(from, y(note[KEY]) - thick / 2, long, thick, Math.min(3, long / 3, thick / 3));
    else context.rect(from, y(note[KEY]) - thick / 2, long, thick);
    context.fill();
    if (now) { context.strokeStyle = theme.mark; context.lineWidth = 1.5; context.stroke(); }
  });
  context.globalAlpha = 1;
  context.strokeStyle = theme.mark; context.lineWidth = 1.5;
  context.beginPath(); context.moveTo(x(tick), 6); context.lineTo(x(tick), 12 + h + 4); context.stroke();
  context.restore();
}

function seconds(ticks) {
  const s = Math.floor(ticks / ticksPerSecond() + 1e-6);
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
  const bars = Math.ceil(end / bar), here = Math.min(bars, Math.floor(tick / bar) + 1);
  const text = seconds(tick) + " / " + seconds(end);
  if (document.activeElement !== place || !dragging) place.value = tick / end * 1000;
  if (text + here !== shownText) {
    shownText = text + here;
    element("place-text").textContent = text;
    place.setAttribute("aria-valuetext", "bar " + here + " of " + bars + ", " + seconds(tick));
  }
}
function frame() {
  if (!playing) return;
  settle();
  draw();
  requestAnimationFrame(frame);
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
  seek(rollFrom + Math.min(1, Math.max(0, part)) * shownTicks);
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
  } else if (event.key === "ArrowLeft") {
    seek(tickAt(clock()) - bar);
  } else if (event.key === "ArrowRight") {
    seek(tickAt(clock()) + bar);
  } else if (event.key === "Home") {
    seek(0);
  }
});
dark.addEventListener("change", layout);
new ResizeObserver(layout).observe(element("panels"));
tempo.value = speed;
label();
layout();

window.sikku = {
  notes,
  state() {
    settle();
    const time = clock();
    return {playing, time, tick: Math.min(end, tickAt(time)), tempo: speed, sounded, recent: recent.slice()};
  },
  play, pause() { if (playing) { stop(); draw(); } }, seek, colour: index => colours[index]
};
)js";

void write_ramp(std::string& out, const std::array<std::string_view, 9>& ramp) {
    out += '[';
    for (const std::string_view colour : ramp) fmt::format_to(std::back_inserter(out), "\"{}\",", colour);
    out.back() = ']';
}

}  // namespace

void NoteCollector::notes(std::span<const Note> notes) {
    if (notes.size() > most_ - notes_.size()) {
        throw ScoreError(
            fmt::format("a picture or a page holds at most {} notes, and this melody has more; "
                        "--bars takes a part of it",
                        most_));
    }
    notes_.insert(notes_.end(), notes.begin(), notes.end());
}

void write_music_svg(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& sink) {
    const Melody melody = survey(notes, end);
    Pieces out(sink);
    const std::string title = title_of(head);
    // The head is the one of prints, so that the pattern is found again in the same way.
    out.text() += fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:sikku=\"urn:sikku:print\"\n"
        "     width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\" font-family=\"'DejaVu Sans', Helvetica, "
        "Arial, "
        "sans-serif\">\n<title>{2}</title>\n<desc>",
        number(page_width), number(page_height), xml_escaped(title));
    out.text() += xml_escaped(head.pattern);
    out.text() += fmt::format("</desc>\n<metadata>\n<sikku:made>{}</sikku:made>\n", xml_escaped(head.made));
    if (!fits_xml(head.pattern)) {
        out.text() += fmt::format("<sikku:pattern>{}</sikku:pattern>\n", to_hex(head.pattern));
    }
    out.text() += fmt::format(
        "</metadata>\n<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n"
        "<text fill=\"#22222a\" font-size=\"6.5\" x=\"{}\" y=\"20\">{}</text>\n"
        "<text fill=\"#5c5c68\" font-size=\"3.2\" x=\"{}\" y=\"26.5\">{}</text>\n",
        number(page_width), number(page_height), number(page_margin), xml_escaped(shortened(title, 64)),
        number(page_margin), xml_escaped(subtitle(head, melody)));
    if (!head.made.empty()) {
        out.text() += fmt::format(
            "<text fill=\"#8a8a95\" font-size=\"2.6\" text-anchor=\"end\" x=\"{}\" y=\"{}\">{}</text>\n",
            number(page_width - page_margin), number(page_height - 8.0), xml_escaped(shortened(head.made, 140)));
    }
    Panel roll{page_margin + key_names_width, panels_top, page_width - 2.0 * page_margin - key_names_width,
               panels_bottom - panels_top};
    if (melody.has_curve()) {
        // As wide as the curve wants at full height, but a third of the page at least and half of it at most.
        const glm::dvec2 extent = melody.curve_high - melody.curve_low;
        const double wanted = extent.y > 0.0 ? roll.height * extent.x / extent.y : page_width;
        Panel curve{page_margin, panels_top, std::clamp(wanted, 80.0, 140.0), roll.height};
        const double taken = curve.width + between_panels;
        roll.left += taken;
        roll.width -= taken;
        write_curve(melody, curve, out);
    }
    write_roll(head, melody, roll, out);
    out.text() += "</svg>\n";
    out.flush();
}

void write_music_page(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& sink) {
    const Melody melody = survey(notes, end);
    Pieces out(sink);
    const std::string title = xml_escaped(title_of(head));
    // The slider reaches a quarter and four times of the tempo, whatever that is.
    const double slowest = head.tempo < 8.0 ? head.tempo / 4.0 : std::floor(head.tempo / 4.0);
    const double fastest = std::ceil(head.tempo * 4.0);
    out.text() += fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
        "style-src 'unsafe-inline'; img-src data:\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<meta name=\"generator\" content=\"{}\"/>\n<link rel=\"icon\" href=\"data:,\"/>\n<title>{}</title>\n<style>",
        xml_escaped(head.made), title);
    out.text() += page_style;
    out.text() += fmt::format(
        "</style>\n</head>\n<body>\n<main>\n<h1>{}</h1>\n<p class=\"about\">{}</p>\n"
        "<div class=\"bar\" role=\"group\" aria-label=\"Playing\">\n"
        "<button type=\"button\" id=\"play\"><svg viewBox=\"0 0 10 10\" aria-hidden=\"true\"><path "
        "d=\"M1 0l8 5-8 5z\"/></svg><span>Play</span></button>\n"
        "<label class=\"long\">Position <input type=\"range\" id=\"place\" min=\"0\" max=\"1000\" step=\"any\" "
        "value=\"0\"/> <output id=\"place-text\"></output></label>\n"
        "<label>Tempo <input type=\"range\" id=\"tempo\" min=\"{}\" max=\"{}\" step=\"any\" value=\"{}\"/> "
        "<output id=\"tempo-text\"></output></label>\n</div>\n",
        title, xml_escaped(subtitle(head, melody)), number(slowest, 4), number(fastest, 4), number(head.tempo, 4));
    out.text() +=
        "<div class=\"panels\" id=\"panels\">\n"
        "<figure class=\"curve\"><canvas id=\"curve\" role=\"img\" aria-label=\"The curve, drawn note by note as "
        "they "
        "sound\"></canvas><canvas id=\"curve-top\" aria-hidden=\"true\"></canvas></figure>\n"
        "<figure class=\"roll\"><canvas id=\"roll\" role=\"img\" aria-label=\"Piano roll: time to the right, pitch "
        "upwards; a click goes there\"></canvas></figure>\n</div>\n"
        "<p class=\"hint\"><kbd>Space</kbd> plays and pauses, <kbd>←</kbd> <kbd>→</kbd> go by a bar, <kbd>Home</kbd> "
        "goes to the beginning.</p>\n<noscript><p>To play, this page needs JavaScript.</p></noscript>\n";
    if (!head.pattern.empty()) {
        out.text() += "<details>\n<summary>The pattern</summary>\n<pre tabindex=\"0\">";
        // HTML drops a line feed that stands first.
        if (head.pattern.front() == '\n') out.text() += '\n';
        out.text() += xml_escaped(head.pattern);
        out.text() += "</pre>\n</details>\n";
    }
    out.text() += fmt::format(
        "</main>\n<script type=\"application/json\" "
        "id=\"score\">{{\"quarter\":{},\"bar\":{},\"end\":{},\"tempo\":{},",
        ticks_per_quarter, std::max<std::int64_t>(head.meter.bar(), 1), melody.end, number(head.tempo, 4));
    out.text() += "\"paper\":";
    write_ramp(out.text(), paper_ramp);
    out.text() += ",\"screen\":";
    write_ramp(out.text(), screen_ramp);
    out.text() += ",\"notes\":[";
    bool first = true;
    for (const Note& note : melody.notes) {
        std::string& text = out.text();
        fmt::format_to(std::back_inserter(text), "{}[{},{},", first ? "\n" : ",\n", note.onset, note.duration);
        first = false;
        put(text, note.key, 4);
        fmt::format_to(std::back_inserter(text), ",{},{}", note.voice, note.velocity);
        for (const double value : {note.from.x, note.from.y, note.to.x, note.to.y}) {
            text += ',';
            put(text, value, 4);
        }
        text += ']';
    }
    out.text() += "]}</script>\n<script>";
    out.text() += page_script;
    out.text() += "</script>\n</body>\n</html>\n";
    out.flush();
}

}  // namespace sikku
