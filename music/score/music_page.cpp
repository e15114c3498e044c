#include "music/score/music_page.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "music/score/bar_lines.h"
#include "music/score/glides.h"
#include "music/score/labels.h"
#include "music/score/note_order.h"
#include "music/score/text_writer.h"
#include "music/score/turns.h"

#include <embedded/music_page.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

// ---- texts and numbers

/// A text of at most `most` characters (not bytes), else its beginning and an ellipsis.
std::string shortened(std::string_view text, std::size_t most) {
    std::size_t bytes = 0;
    for (std::size_t count = 0; bytes < text.size(); ++count) {
        if (count == most) return std::string(text.substr(0, bytes)) + "…";
        bytes += std::max<std::size_t>(1, utf8_length(text.substr(bytes)));
    }
    return std::string(text);
}

// ---- colours

/// From the lowest key to the highest, evenly lighter (OKLCH): L 0.40 to 0.72 for paper, 0.62 to 0.90 for a dark
/// screen, the hue from blue over red to yellow. So the order is visible in grey and to colour-blind readers.
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

/// The colour `#rrggbb` at a position of a ramp, 0 to 1.
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

// ---- melody, for both writers

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
    sort_by_time(melody.notes);
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
        melody.low = std::min(melody.low, last_key(note));
        melody.high = std::max(melody.high, last_key(note));
        for (const glm::dvec2 point : {note.from, note.to, note.end_point()}) {
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

/// Finds silent pieces: gaps parallel to an axis are runs of the curve, others are jumps, as after a bracket.
std::vector<Joint> joints(const Melody& melody) {
    constexpr double nothing = 1e-6;
    std::vector<Joint> result;
    std::vector<const Note*> last;
    for (const Note& note : melody.notes) {
        const auto voice = static_cast<std::size_t>(std::max<int>(note.voice, 0));
        if (voice >= last.size()) last.resize(voice + 1, nullptr);
        if (const Note* before = last[voice]) {
            const bool across = std::abs(note.from.x - before->end_point().x) > nothing;
            const bool up = std::abs(note.from.y - before->end_point().y) > nothing;
            if (across != up) result.push_back({before->end_point(), note.from});
        }
        last[voice] = &note;
    }
    return result;
}

/// Tempo, meter and parts in words.
std::string subtitle(const ScoreHead& head, const Melody& melody) {
    std::vector<std::string> tempos, meters;
    const auto add = [](std::vector<std::string>& list, const std::string& one) {
        if (std::find(list.begin(), list.end(), one) == list.end()) list.push_back(one);
    };
    const auto add_frame = [&](double tempo, const Meter& meter) {
        add(tempos, number(tempo, 2));
        add(meters, fmt::format("{}/{}", meter.beats, meter.unit));
    };
    add_frame(head.tempo, head.meter);
    for (const SectionChange& change : head.changes) add_frame(change.to.tempo, change.to.meter);
    std::string text =
        fmt::format("{} {}, {} quarters a minute, {}", melody.notes.size(),
                    melody.notes.size() == 1 ? "note" : "notes", fmt::join(tempos, ", "), fmt::join(meters, ", "));
    std::set<std::string> told;
    for (const Part& part : head.parts) {
        const std::string words = part.scale.empty() ? part.name : fmt::format("{}, {}", part.name, part.scale);
        if (told.insert(words).second) text += " · " + words;
    }
    return head.source.empty() ? text : fmt::format("{} · {}", shortened(head.source, 90), text);
}

/// Where the length of bars changes: [tick, length]. The bar of an upbeat begins before the score.
std::string bars_text(const ScoreHead& head) {
    const std::int64_t bar = std::max<std::int64_t>(head.meter.bar(), 1);
    std::string text = fmt::format("[{},{}]", head.upbeat > 0 ? head.upbeat - bar : 0, bar);
    for (const SectionChange& change : head.changes) {
        text += fmt::format(",[{},{}]", change.onset, change.to.meter.bar());
    }
    return text;
}

/// Writes changes of tempo, and points of pan and pitch: [voice, tick, number, value].
void write_curves(TextWriter& out, const Curves& curves, const std::vector<TempoPoint>& tempos) {
    std::string_view comma;
    out.put("\"tempos\":[");
    for (const TempoPoint& point : tempos) {
        out.put("{}[{},{}]", std::exchange(comma, ","), point.tick, number(point.factor, 4));
    }
    out.put("],\"controls\":[");
    comma = {};
    for (const ControlPoint& point : curves.controls) {
        if (point.number != ControlPoint::pan && point.number != ControlPoint::bend) continue;
        out.put("{}[{},{},{},{}]", std::exchange(comma, ","), point.voice, point.tick, point.number,
                number(point.value, 4));
    }
    out.put("],");
}

/// Writes the voices of each printed part: [name, voices].
void write_parts(TextWriter& out, const ScoreHead& head, const Melody& melody) {
    std::vector<std::vector<Note>> voices;
    for (const Part& part : head.parts) voices.resize(voices.size() + static_cast<std::size_t>(part.voices));
    for (const Note& note : melody.notes) {
        if (static_cast<std::size_t>(note.voice) < voices.size()) {
            voices[static_cast<std::size_t>(note.voice)].push_back(note);
        }
    }
    const std::vector<PrintedPart> printed = share_parts(head.parts, voices, BarLines(head));
    std::vector<Part> players;
    for (const PrintedPart& one : printed) players.push_back(one.part);
    const std::vector<Label> labels = labels_of(players);
    std::vector<int> first_voice = {0};
    for (const Part& part : head.parts) first_voice.push_back(first_voice.back() + part.voices);
    out.put("\"parts\":[");
    for (std::size_t i = 0; i < printed.size(); ++i) {
        // The name stands within a script.
        std::string name = json_string(labels[i].name);
        for (std::size_t at = name.find('<'); at != std::string::npos; at = name.find('<', at)) {
            name.replace(at, 1, "\\u003c");
        }
        out.put("{}[{},[", i > 0 ? "," : "", name);
        std::string_view comma;
        for (const std::size_t source : printed[i].sources) {
            for (int voice = first_voice[source]; voice < first_voice[source + 1]; ++voice) {
                out.put("{}{}", std::exchange(comma, ","), voice);
            }
        }
        out.put("]]");
    }
    out.put("],");
}

/// The ticks at which phrases begin, ascending.
std::vector<std::int64_t> phrase_begins(const Melody& melody) {
    std::vector<std::int64_t> begins;
    for (const Note& note : melody.notes) {
        if (note.begins_phrase && (begins.empty() || begins.back() != note.onset)) begins.push_back(note.onset);
    }
    return begins;
}

/// The voices of drums.
std::vector<int> drum_voices(const ScoreHead& head) {
    std::vector<int> voices;
    int voice = 0;
    for (const Part& part : head.parts) {
        for (int i = 0; i < part.voices; ++i, ++voice) {
            if (part.is_drums) voices.push_back(voice);
        }
    }
    return voices;
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
constexpr double narrowest_note = 0.8;  // two pixels of a screen that shows the whole page

void write_curve(const Melody& melody, const Panel& panel, TextWriter& out) {
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
    out.put("<g id=\"curve\" fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{}\">\n", number(width));
    // Writes several paths, as readers refuse very long attributes.
    constexpr std::size_t joints_of_a_path = 1000;
    for (std::size_t i = 0; i < gaps.size(); i += joints_of_a_path) {
        out.put("<path class=\"silent\" stroke=\"#9a9aa5\" stroke-width=\"{}\" d=\"",
                number(std::max(0.3 * width, 0.05)));
        for (std::size_t k = i; k < std::min(i + joints_of_a_path, gaps.size()); ++k) {
            const glm::dvec2 from = place(gaps[k].from);
            const glm::dvec2 to = place(gaps[k].to);
            out.put("M{} {}L{} {}", number(from.x), number(from.y), number(to.x), number(to.y));
        }
        out.put("\"/>\n");
    }
    for (const Note& note : melody.notes) {
        const glm::dvec2 from = place(note.from);
        const glm::dvec2 to = place(note.to);
        out.put("<line stroke=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n",
                ramp_colour(paper_ramp, melody.height(note.key)), number(from.x), number(from.y), number(to.x),
                number(to.y));
        if (note.glide.rise == 0) continue;
        out.put("<path class=\"glide\" stroke=\"{}\" d=\"M{} {}V{}\"/>\n",
                ramp_colour(paper_ramp, melody.height(last_key(note))), number(to.x), number(to.y),
                number(place(note.end_point()).y));
    }
    out.put("</g>\n");
}

void write_roll(const ScoreHead& head, const Melody& melody, const Panel& panel, TextWriter& out) {
    // At least an octave high, so that a few notes do not become wide bars.
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

    out.put("<g id=\"keys\">\n");
    out.put("<rect fill=\"#fafafc\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", number(panel.left),
            number(panel.top), number(panel.width), number(panel.height));
    for (int key = low; key <= high; ++key) {
        if (!is_black(key)) continue;
        out.put("<rect fill=\"#f0f0f4\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", number(panel.left),
                number(middle(key) - 0.5 * row), number(panel.width), number(row));
    }
    for (int key = low; key <= high; ++key) {
        if (((key % 12) + 12) % 12 != 0) continue;
        const double line = middle(key) + 0.5 * row;
        out.put(
            "<path class=\"octave\" stroke=\"#b9b9c4\" stroke-width=\"0.15\" d=\"M{} {}h{}\"/>\n"
            "<text fill=\"#5c5c68\" font-size=\"2.8\" text-anchor=\"end\" x=\"{}\" y=\"{}\">C{}</text>\n",
            number(panel.left), number(line), number(panel.width), number(panel.left - 1.2),
            number(middle(key) + 1.0), (key + 120) / 12 - 11);
    }
    out.put("</g>\n<g id=\"bars\">\n");
    // Every bar, or every 2nd, 4th, 8th if lines would merge into grey; a number at most every 12 mm.
    const BarLines bars(head);
    std::int64_t shortest = bars.length(0);
    for (const SectionChange& change : head.changes) shortest = std::min(shortest, change.to.meter.bar());
    const auto bar = static_cast<double>(shortest) * width_of_tick;
    std::int64_t every = 1;
    while (bar * static_cast<double>(every) < 3.0) every *= 2;
    std::int64_t named = every;
    while (bar * static_cast<double>(named) < 12.0) named *= 2;
    const std::int64_t first = bars.upbeat() > 0 ? 1 : 0;
    for (std::int64_t i = first; bars.onset(i) <= melody.end; i += every) {
        const std::int64_t onset = bars.onset(i);
        out.put("<path class=\"bar\" stroke=\"#cfcfd8\" stroke-width=\"0.12\" d=\"M{} {}V{}\"/>\n",
                number(across(onset)), number(panel.top), number(bottom));
        if ((i - first) % named == 0 && onset < melody.end) {
            out.put("<text fill=\"#5c5c68\" font-size=\"2.8\" x=\"{}\" y=\"{}\">{}</text>\n", number(across(onset)),
                    number(bottom + 4.0), i - first + 1);
        }
    }
    out.put("</g>\n<g id=\"roll\">\n");
    const double thick = std::max(0.86 * row, 0.6);
    for (const Note& note : melody.notes) {
        // A gap at the end separates repeated notes.
        const std::int64_t level = note.duration - note.glide.ticks;
        const double full = width_of_tick * static_cast<double>(level);
        // Notes of a very long score overlap rather than vanish.
        const double width = std::max(full > 0.6 ? full - 0.2 : full * 0.7, narrowest_note);
        out.put("<rect fill=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\"/>\n",
                ramp_colour(paper_ramp, melody.height(note.key)), number(across(note.onset)),
                number(middle(note.key) - 0.5 * thick), number(width), number(thick),
                number(std::min({0.4, 0.3 * thick, 0.3 * width})));
        if (note.glide.ticks == 0) continue;
        out.put("<path class=\"glide\" stroke=\"{}\" stroke-width=\"{}\" d=\"M{} {}L{} {}\"/>\n",
                ramp_colour(paper_ramp, melody.height(note.key)), number(0.5 * thick),
                number(across(note.onset + level)), number(middle(note.key)),
                number(across(note.onset + note.duration)), number(middle(last_key(note))));
    }
    out.put("</g>\n");
}

// ---- the page

std::string ramp_text(const std::array<std::string_view, 9>& ramp) {
    return fmt::format("[\"{}\"]", fmt::join(ramp, "\",\""));
}

}  // namespace

void NoteCollector::notes(std::span<const Note> notes) {
    if (notes.size() > most_ - notes_.size()) {
        throw ScoreError(
            fmt::format("a picture or a page holds at most {} notes, and this melody has more; "
                        "limit the bars or seconds",
                        most_));
    }
    notes_.insert(notes_.end(), notes.begin(), notes.end());
}

void NoteCollector::controls(std::span<const ControlPoint> points) {
    std::vector<ControlPoint>& all = curves_.controls;
    if (points.size() > most_points - all.size()) {
        throw ScoreError(fmt::format(
            "the curves of pan, controllers and gamakas have more than {} points; limit the bars", most_points));
    }
    all.insert(all.end(), points.begin(), points.end());
}

void NoteCollector::finish(std::int64_t end) {
    end_ = end;
    std::stable_sort(curves_.controls.begin(), curves_.controls.end(),
                     [](const ControlPoint& a, const ControlPoint& b) {
                         return std::tie(a.voice, a.tick) < std::tie(b.voice, b.tick);
                     });
}

void write_music_svg(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& sink) {
    const Melody melody = survey(notes, end);
    TextWriter out(sink);
    const std::string title = title_of(head);
    // The head is that of prints, so that the pattern can be read in the same way.
    out.put(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:sikku=\"urn:sikku:print\"\n"
        "     width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\" font-family=\"'DejaVu Sans', Helvetica, "
        "Arial, "
        "sans-serif\">\n<title>{2}</title>\n<desc>{3}</desc>\n<metadata>\n<sikku:made>{4}</sikku:made>\n",
        number(page_width), number(page_height), xml_escaped(title), xml_escaped(head.pattern),
        xml_escaped(head.made));
    if (!fits_xml(head.pattern)) {
        out.put("<sikku:pattern>{}</sikku:pattern>\n", to_hex(head.pattern));
    }
    out.put(
        "</metadata>\n<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n"
        "<text fill=\"#22222a\" font-size=\"6.5\" x=\"{}\" y=\"20\">{}</text>\n"
        "<text fill=\"#5c5c68\" font-size=\"3.2\" x=\"{}\" y=\"26.5\">{}</text>\n",
        number(page_width), number(page_height), number(page_margin), xml_escaped(shortened(title, 64)),
        number(page_margin), xml_escaped(subtitle(head, melody)));
    if (!head.made.empty()) {
        out.put("<text fill=\"#8a8a95\" font-size=\"2.6\" text-anchor=\"end\" x=\"{}\" y=\"{}\">{}</text>\n",
                number(page_width - page_margin), number(page_height - 8.0), xml_escaped(shortened(head.made, 140)));
    }
    Panel roll{page_margin + key_names_width, panels_top, page_width - 2.0 * page_margin - key_names_width,
               panels_bottom - panels_top};
    if (melody.has_curve()) {
        // The width of the curve at full height, but at least a third and at most half of the page.
        const glm::dvec2 extent = melody.curve_high - melody.curve_low;
        const double wanted = extent.y > 0.0 ? roll.height * extent.x / extent.y : page_width;
        Panel curve{page_margin, panels_top, std::clamp(wanted, 80.0, 140.0), roll.height};
        const double taken = curve.width + between_panels;
        roll.left += taken;
        roll.width -= taken;
        write_curve(melody, curve, out);
    }
    write_roll(head, melody, roll, out);
    out.put("</svg>\n");
    out.flush();
}

void write_music_page(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& sink,
                      const Curves& curves) {
    const Melody melody = survey(notes, end);
    TextWriter out(sink);
    const std::string title = xml_escaped(title_of(head));
    // The slider ranges from a quarter of the tempo to four times the tempo.
    const double slowest = head.tempo < 8.0 ? head.tempo / 4.0 : std::floor(head.tempo / 4.0);
    const double fastest = std::ceil(head.tempo * 4.0);
    out.put(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
        "style-src 'unsafe-inline'; img-src data:\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<meta name=\"generator\" content=\"{}\"/>\n<link rel=\"icon\" "
        "href=\"data:,\"/>\n<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n<h1>{}</h1>\n<p "
        "class=\"about\">{}</p>\n"
        "<div class=\"bar\" role=\"group\" aria-label=\"Playing\">\n"
        "<button type=\"button\" id=\"play\"><svg viewBox=\"0 0 10 10\" aria-hidden=\"true\"><path "
        "d=\"M1 0l8 5-8 5z\"/></svg><span>Play</span></button>\n"
        "<label class=\"long\">Position <input type=\"range\" id=\"place\" min=\"0\" max=\"1000\" step=\"any\" "
        "value=\"0\" list=\"phrase-begins\" aria-label=\"Position\"/><datalist id=\"phrase-begins\"></datalist> "
        "<span id=\"place-text\" aria-hidden=\"true\"></span></label>\n"
        "<label>Tempo <input type=\"range\" id=\"tempo\" min=\"{}\" max=\"{}\" step=\"any\" value=\"{}\"/> "
        "<output id=\"tempo-text\"></output></label>\n"
        "<span class=\"part\"><button type=\"button\" class=\"small\" id=\"loop\" "
        "aria-pressed=\"false\">Loop</button>"
        "<label>bars <input type=\"number\" id=\"loop-from\" min=\"1\" value=\"1\"/></label>"
        "<label>to <input type=\"number\" id=\"loop-to\" min=\"1\" value=\"1\"/></label></span>\n"
        "<span class=\"part\" id=\"phrases\" hidden=\"\">Phrase <button type=\"button\" class=\"small\" "
        "id=\"phrase-before\" aria-label=\"Previous phrase\">◂</button><button type=\"button\" class=\"small\" "
        "id=\"phrase-after\" aria-label=\"Next phrase\">▸</button></span>\n</div>\n"
        "<div class=\"bar\" id=\"parts\" role=\"group\" aria-label=\"Parts\" hidden=\"\"></div>\n"
        "<div class=\"panels\" id=\"panels\">\n"
        "<figure class=\"curve\"><canvas id=\"curve\" role=\"img\" aria-label=\"The curve, drawn note by note as "
        "they "
        "sound\"></canvas><canvas id=\"curve-top\" aria-hidden=\"true\"></canvas></figure>\n"
        "<figure class=\"roll\"><canvas id=\"roll\" role=\"img\" aria-label=\"Piano roll: time to the right, pitch "
        "upwards; a click goes there\"></canvas></figure>\n</div>\n"
        "<p class=\"hint\"><kbd>Space</kbd> plays and pauses, <kbd>←</kbd> <kbd>→</kbd> move by one bar, "
        "<kbd>Home</kbd> "
        "goes to the beginning, <kbd>L</kbd> loops, <kbd>[</kbd> <kbd>]</kbd> "
        "set its first and last bar to the current one<span id=\"phrase-hint\" hidden=\"\">, <kbd>Shift</kbd> "
        "<kbd>←</kbd> <kbd>→</kbd> move by one phrase</span>.</p>\n<noscript><p>To play, this page needs "
        "JavaScript.</p></noscript>\n",
        xml_escaped(head.made), title, page_css, title, xml_escaped(subtitle(head, melody)), number(slowest, 4),
        number(fastest, 4), number(head.tempo, 4));
    if (!head.pattern.empty()) {
        // HTML drops a leading line feed.
        out.put("<details>\n<summary>The pattern</summary>\n<pre tabindex=\"0\">{}{}</pre>\n</details>\n",
                head.pattern.front() == '\n' ? "\n" : "", xml_escaped(head.pattern));
    }
    out.put(
        "</main>\n<script type=\"application/json\" "
        "id=\"score\">{{\"quarter\":{},\"bars\":[{}],\"end\":{},\"tempo\":{},",
        ticks_per_quarter, bars_text(head), melody.end, number(head.tempo, 4));
    write_curves(out, curves, tempo_map(head, curves, end));
    write_parts(out, head, melody);
    out.put("\"phrases\":[{}],", fmt::join(phrase_begins(melody), ","));
    out.put("\"drums\":[{}],\"paper\":{},\"screen\":{},\"notes\":[", fmt::join(drum_voices(head), ","),
            ramp_text(paper_ramp), ramp_text(screen_ramp));
    std::string_view separator = "\n";
    for (const Note& note : melody.notes) {
        out.put("{}[{},{},{},{},{}", std::exchange(separator, ",\n"), note.onset, note.duration, number(note.key, 4),
                note.voice, note.velocity);
        for (const double value : {note.from.x, note.from.y, note.to.x, note.to.y}) out.put(",{}", number(value, 4));
        if (note.glide.ticks > 0) {
            out.put(",{},{},{}", note.glide.ticks, number(static_cast<double>(note.glide.semitones), 4),
                    number(static_cast<double>(note.glide.rise), 4));
        }
        out.put("]");
    }
    out.put("]}}</script>\n<script>\n{}</script>\n</body>\n</html>\n", page_js);
    out.flush();
}

}  // namespace sikku
