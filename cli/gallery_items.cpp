#include "cli/gallery_items.h"

#include "art/style/style.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <istream>
#include <span>

namespace sikku {
namespace {

/// Keys with values of all items together.
constexpr std::size_t most_settings = 10'000'000;
constexpr std::size_t longest_line = std::size_t{16} << 20;

/// Formats of prints, then of scores.
constexpr std::array<std::string_view, 12> print_formats = {"svg",  "pdf", "png",  "tif", "tiff",  "jpg",
                                                            "jpeg", "exr", "hpgl", "plt", "gcode", "nc"};
constexpr std::array<std::string_view, 9> score_formats = {"mid", "midi", "musicxml",  "xml", "ly",
                                                           "wav", "flac", "notes.svg", "html"};

bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// `A:B` or `A:B:STEP`; nullopt for what is none.
std::optional<GalleryRange> read_range(const std::string& key, const std::string& text, const std::string& place) {
    std::vector<double> numbers;
    for (std::size_t at = 0;;) {
        const std::size_t colon = std::min(text.find(':', at), text.size());
        double number = 0;
        if (!read_number(std::string_view(text).substr(at, colon - at), number)) return std::nullopt;
        numbers.push_back(number);
        if (colon == text.size()) break;
        at = colon + 1;
    }
    if (numbers.size() < 2 || numbers.size() > 3) return std::nullopt;
    GalleryRange range{numbers[0], numbers.size() == 3 ? numbers[2] : 1.0, 0};
    const double steps = (numbers[1] - range.first) / range.step;
    if (range.step == 0 || !(steps >= 0)) {
        fail(place, fmt::format("{}: the range {} holds nothing", key, printable(text, 80)));
    }
    range.count = std::floor(steps + 1e-9) + 1;
    return range;
}

std::vector<std::string> words_of(const GalleryValue& value, std::string_view key) {
    std::vector<std::string> words;
    if (value.type == GalleryValue::Type::text) {
        words.push_back(value.text);
    } else if (value.type == GalleryValue::Type::list) {
        for (const GalleryValue& element : value.list) {
            if (element.type != GalleryValue::Type::text)
                fail(element.place, fmt::format("{}: expected a string", key));
            words.push_back(element.text);
        }
    } else {
        fail(value.place, fmt::format("{}: expected a string or a list of strings", key));
    }
    if (words.empty()) fail(value.place, fmt::format("{}: this list is empty", key));
    return words;
}

bool is_whole(const std::string& text) {
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && stop == text.data() + text.size();
}

bool has_control(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](char byte) {
        return static_cast<unsigned char>(byte) < ' ' && byte != '\t' && byte != '\n' && byte != '\r';
    });
}

/// @param facts  null: of a key of the pattern's own
void check_value(const std::string& key, const GalleryKeyFacts* facts, const std::string& value,
                 const std::string& place) {
    if (!fits_xml(value)) {
        fail(place, fmt::format("{}: '{}' contains {}", key, printable(value, 80),
                                has_control(value) ? "a control character" : "invalid UTF-8"));
    }
    if (!facts) return;
    const GalleryKind kind = facts->kind;
    double number = 0;
    const bool is_number = read_number(value, number);
    if (kind == GalleryKind::number && !is_number) {
        fail(place, fmt::format("{}: expected a number, not '{}'", key, printable(value, 80)));
    }
    if (kind == GalleryKind::whole && !is_whole(value)) {
        fail(place, fmt::format("{}: expected a whole number, 0 or more, not '{}'", key, printable(value, 80)));
    }
    if (kind == GalleryKind::flag && value != "true" && value != "false") {
        fail(place, fmt::format("{}: expected true or false, not '{}'", key, printable(value, 80)));
    }
    if ((kind == GalleryKind::number || kind == GalleryKind::whole) && number < facts->least) {
        fail(place, fmt::format("{}: expected {:g} or more, not '{}'", key, facts->least, printable(value, 80)));
    }
    if ((kind == GalleryKind::number || kind == GalleryKind::whole) && number > facts->most) {
        fail(place, fmt::format("{}: expected {:g} at most, not '{}'", key, facts->most, printable(value, 80)));
    }
}

/// @param facts  null: of a key of the pattern's own
void check_range(const std::string& key, const GalleryRange& range, const std::string& word,
                 const GalleryKeyFacts* facts, const std::string& place) {
    if (!facts) return;
    if (facts->kind == GalleryKind::flag) check_value(key, facts, word, place);
    const bool is_countable = range.count <= most_gallery_jobs;
    if (facts->kind == GalleryKind::whole) {
        const auto is_whole_number = [](double value) {
            return value >= 0 && value == std::floor(value) && value < 1e11;
        };
        const double last = range.first + (range.count - 1) * range.step;
        if (!is_whole_number(range.first) || range.step != std::floor(range.step) ||
            (is_countable && !is_whole_number(last))) {
            fail(place, fmt::format("{}: expected whole numbers, 0 or more", key));
        }
    }
    check_value(key, facts, range.value(0), place);
    if (is_countable) check_value(key, facts, range.value(static_cast<std::uint64_t>(range.count) - 1), place);
}

void check_format(const std::string& format, const std::string& place) {
    if (is_one_of(format, print_formats) || is_one_of(format, score_formats)) return;
    std::vector<std::string_view> known(print_formats.begin(), print_formats.end());
    known.insert(known.end(), score_formats.begin(), score_formats.end());
    const std::string_view near = nearest(format, known);
    fail(place, fmt::format("unknown format '{}'{}", printable(format, 80),
                            near.empty() ? fmt::format("; expected one of {}", fmt::join(known, ", "))
                                         : fmt::format("; did you mean '{}'?", near)));
}

/// Commas part several, on the command line as in a file.
std::vector<std::string> read_formats(const std::vector<std::string>& words, const std::string& place) {
    std::vector<std::string> formats;
    for (const std::string& word : words) {
        for (std::size_t at = 0; at <= word.size();) {
            const std::size_t comma = std::min(word.find(',', at), word.size());
            std::string format = lower_case(word.substr(at, comma - at));
            while (format.starts_with(' ') || format.starts_with('.')) format.erase(0, 1);
            while (format.ends_with(' ')) format.pop_back();
            check_format(format, place);
            if (std::find(formats.begin(), formats.end(), format) != formats.end())
                fail(place, fmt::format("format: '{}' is listed twice", format));
            formats.push_back(format);
            at = comma + 1;
        }
    }
    return formats;
}

/// The next line, without its end; false at the end of the stream.
bool next_line(std::istream& stream, std::string& line, const std::string& place) {
    line.clear();
    std::streambuf& buffer = *stream.rdbuf();
    constexpr int end = std::char_traits<char>::eof();
    int byte = buffer.sbumpc();
    if (byte == end) return false;
    for (; byte != end && byte != '\n'; byte = buffer.sbumpc()) {
        line += static_cast<char>(byte);
        if (line.size() > longest_line) fail(place, "this line is longer than 16 MB");
    }
    return true;
}

}  // namespace

const std::vector<GalleryKeyFacts>& all_gallery_keys() {
    static const std::vector<GalleryKeyFacts> keys = [] {
        std::vector<GalleryKeyFacts> list = {
            {{"n", "Derivation length, or a range of them: 1:6", false, true},
             GalleryUse::any,
             GalleryKind::whole,
             false},
            {{"variant", "One of the pattern's variants", false, true}, GalleryUse::any, GalleryKind::text, false},
            {{"budget", "Maximum number of derivation nodes visited", false, true},
             GalleryUse::any,
             GalleryKind::number,
             false,
             1},
            {{"seed", "Random seed", false, true}, GalleryUse::any, GalleryKind::whole, false},
            {{"size", "Page size of a print: A0 to A6, letter, legal, tabloid, or WIDTHxHEIGHT", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"landscape", "Landscape page", true, true}, GalleryUse::print, GalleryKind::flag, false},
            {{"margin", "Margin on all four sides", false, true}, GalleryUse::print, GalleryKind::text, false},
            {{"fit", "Fill the page within its margins (default)", true, true},
             GalleryUse::print,
             GalleryKind::flag,
             false},
            {{"step", "Length of one turtle step on paper", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"rotate", "Rotation in degrees anticlockwise", false, true},
             GalleryUse::print,
             GalleryKind::number,
             false},
            {{"mirror", "Mirror left and right", true, true}, GalleryUse::print, GalleryKind::flag, false},
            {{"window", "Part of the drawing that fills the page: X0,Y0,X1,Y1 in turtle steps", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"compression", "PNG compression, 1 (fast) to 9 (small)", false, true},
             GalleryUse::print,
             GalleryKind::whole,
             false,
             1,
             9},
            {{"dpi", "Pixels per inch of pictures", false, true}, GalleryUse::print, GalleryKind::number, false},
            {{"dot-spacing", "Distance between neighbouring dots of a kolam", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"border", "kaavi: a frame of red earth lines", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"colour-by", "strand: each line in a colour of its own", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"animate", "SVG that draws itself; duration in seconds", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"plotter", "Draw nothing twice, with few pen lifts", true, true},
             GalleryUse::print,
             GalleryKind::flag,
             false},
            {{"split", "Maximum length of a plotted stroke", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"travel", "Show pen-up travel", true, true}, GalleryUse::print, GalleryKind::flag, false},
            {{"pen-speed", "Drawing speed in mm per second", false, true},
             GalleryUse::print,
             GalleryKind::number,
             false},
            {{"travel-speed", "Pen-up speed in mm per second", false, true},
             GalleryUse::print,
             GalleryKind::number,
             false},
            {{"lift-time", "Seconds to lift and lower the pen", false, true},
             GalleryUse::print,
             GalleryKind::number,
             false},
            {{"profile", "G-code profile: grbl or z", false, true}, GalleryUse::print, GalleryKind::text, false},
            {{"gcode-start", "G-code lines before the first stroke", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"gcode-end", "G-code lines after the last stroke", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"bleed", "How far the ground extends beyond the page", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"marks", "Crop marks; PDF", true, true}, GalleryUse::print, GalleryKind::flag, false},
            {{"spot", "Spot ink, NAME=COLOUR; PDF", false, true}, GalleryUse::print, GalleryKind::text, false},
            {{"cmyk", "ICC profile of the CMYK inks; TIFF", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"bits", "Bits per channel: 8 or 1 (TIFF)", false, true},
             GalleryUse::print,
             GalleryKind::whole,
             false,
             1,
             8},
            {{"screen", "Screening for 1 bit: threshold, diffusion, halftone or halftone,LPI", false, true},
             GalleryUse::print,
             GalleryKind::text,
             false},
            {{"no-icc", "Omit the ICC colour profile from pictures", true, true},
             GalleryUse::print,
             GalleryKind::flag,
             false},
            {{"angle", "The pattern's angle: its define of that name, or its angle increment", false, true},
             GalleryUse::any,
             GalleryKind::text,
             true},
            {{"angle-increment", "", false, false}, GalleryUse::any, GalleryKind::text, true},
            {{"angle-factor", "", false, false}, GalleryUse::any, GalleryKind::text, true},
            {{"heading", "", false, false}, GalleryUse::any, GalleryKind::text, true},
            {{"turn", "", false, false}, GalleryUse::any, GalleryKind::text, true},
            {{"scale-factor", "", false, false}, GalleryUse::print, GalleryKind::text, true},
        };
        for (const KeyInfo& key : language_keys()) {
            if (key.owner == KeyOwner::engine) continue;
            const bool is_art = key.owner == KeyOwner::art;
            list.push_back({{std::string(key.name), std::string(key.help), false, true},
                            is_art ? GalleryUse::print : GalleryUse::score,
                            GalleryKind::text,
                            is_art});
        }
        const std::vector<GalleryKeyFacts> of_play = {
            {{"from-bar", "First bar", false, true}, GalleryUse::score, GalleryKind::whole, false, 1},
            {{"bars", "Number of bars", false, true}, GalleryUse::score, GalleryKind::whole, false, 1},
            {{"seconds", "Maximum length in seconds", false, true}, GalleryUse::score, GalleryKind::number, false},
            {{"transpose", "Transposition in semitones", false, true}, GalleryUse::score, GalleryKind::number, false},
            {{"humanise", "Deviation from exact playing, 0 to 1", false, true},
             GalleryUse::score,
             GalleryKind::number,
             false},
            {{"midi-format", "MIDI format: 1 (a track for each voice) or 0", false, true},
             GalleryUse::score,
             GalleryKind::whole,
             false},
            {{"tuning", "Microtones by pitch bend or by the MIDI Tuning Standard: bend, mts", false, true},
             GalleryUse::score,
             GalleryKind::text,
             false}};
        list.insert(list.end(), of_play.begin(), of_play.end());
        return list;
    }();
    return keys;
}

const GalleryKeyFacts* find_gallery_key(std::string_view name) {
    for (const GalleryKeyFacts& key : all_gallery_keys()) {
        if (key.shown.name == name) return &key;
    }
    return nullptr;
}

std::string folded_key(std::string key) {
    for (char& letter : key) {
        if (letter == '_' || letter == ' ') letter = '-';
    }
    if (key == "generations" || key == "steps") return "n";
    if (key == "seeds" || key == "formats" || key == "patterns") key.pop_back();
    return key;
}

bool is_score_format(std::string_view format) {
    return is_one_of(format, score_formats);
}

std::string GalleryRange::value(std::uint64_t index) const {
    // Twelve digits, so that 0.1 + 0.2 is 0.3.
    std::string text = fmt::format("{:.12g}", first + static_cast<double>(index) * step);
    return text == "-0" ? "0" : text;
}

const GalleryAxis::Part& GalleryAxis::part_of(std::uint64_t index) const {
    const auto after = std::upper_bound(parts_.begin(), parts_.end(), static_cast<double>(index),
                                        [](double wanted, const Part& part) { return wanted < part.begin; });
    return *std::prev(after);
}

std::string GalleryAxis::value(std::uint64_t index) const {
    const Part& part = part_of(index);
    return part.range ? part.range->value(index - static_cast<std::uint64_t>(part.begin)) : part.text;
}

bool GalleryAxis::is_end(std::uint64_t index) const {
    const Part& part = part_of(index);
    const double within = static_cast<double>(index) - part.begin;
    return !part.range || within == 0 || within + 1 >= part.range->count;
}

void GalleryItem::drop(std::string_view key) {
    std::erase_if(axes, [&](const Axis& axis) { return axis->key == key && !axis->in_set; });
}

void GalleryItem::take(Axis axis) {
    for (Axis& old : axes) {
        if (old->key == axis->key && old->in_set == axis->in_set) {
            old = std::move(axis);
            return;
        }
    }
    axes.push_back(std::move(axis));
}

void GalleryItems::add(GalleryItem item) {
    settings_ += item.axes.size();
    if (static_cast<double>(list.size()) + 1 > most_gallery_jobs) {
        fail(item.place, fmt::format("too many items: at most {:.0f} jobs in one run", most_gallery_jobs));
    }
    if (settings_ > most_settings) {
        fail(item.place, fmt::format("too many settings: at most {} in all items together", most_settings));
    }
    list.push_back(std::move(item));
}

GalleryAxis axis_of(const std::string& key, const GalleryValue& value, const GalleryKeyFacts* facts) {
    GalleryAxis axis(key, value.place, facts == nullptr);
    // These may hold a colon.
    const bool is_prose = !facts && (key == "title" || key == "source" || key == "description");
    for (const std::string& word : words_of(value, key)) {
        const auto range = is_prose ? std::nullopt : read_range(key, word, value.place);
        if (!range) {
            check_value(key, facts, word, value.place);
            axis.add(word);
            continue;
        }
        check_range(key, *range, word, facts, value.place);
        axis.add(*range);
    }
    return axis;
}

void read_gallery_key(const std::string& written, const GalleryValue& value, GalleryItem& item) {
    const std::string key = folded_key(written);
    if (key == "pattern") {
        item.patterns = std::make_shared<const std::vector<std::string>>(words_of(value, key));
        item.patterns_place = value.place;
    } else if (key == "format") {
        item.formats = read_formats(words_of(value, key), value.place);
    } else if (key == "name") {
        if (value.type != GalleryValue::Type::text) fail(value.place, "name: expected a string");
        if (value.text.size() > longest_job_name) {
            fail(value.place, fmt::format("name: '{}' is too long: at most {} bytes", printable(value.text, 80),
                                          longest_job_name));
        }
        item.name = std::make_shared<const std::string>(value.text);
        item.name_place = value.place;
    } else if (key == "set") {
        if (value.type != GalleryValue::Type::table) fail(value.place, "set: expected a table such as { r = 0.5 }");
        for (const auto& [name, element] : value.table) {
            if (name.empty()) fail(element.place, "set: a key is empty; expected the name of a key or define");
            item.take(std::make_shared<const GalleryAxis>(axis_of(name, element, nullptr)));
        }
    } else if (const GalleryKeyFacts* facts = find_gallery_key(key)) {
        item.take(std::make_shared<const GalleryAxis>(axis_of(key, value, facts)));
    } else {
        std::vector<std::string_view> known = {"pattern", "format", "name",    "set",  "generations",
                                               "item",    "poster", "contact", "title"};
        for (const GalleryKeyFacts& each : all_gallery_keys()) known.push_back(each.shown.name);
        const std::string_view near = nearest(key, known);
        fail(value.place, fmt::format("unknown key '{}'{}", printable(written, 80),
                                      near.empty() ? "; keys and defines of patterns go into `set = { … }`"
                                                   : fmt::format("; did you mean '{}'?", near)));
    }
}

void check_sheet_size(const std::string& key, const std::string& size, const std::string& place) {
    DrawSettings settings;
    settings.size = size;
    settings.output = "sheet.svg";
    settings.margin = "0mm";
    try {
        plan_print(settings);
    } catch (const UsageError& error) {
        std::string message = error.what();
        if (message.starts_with("--size")) message.replace(0, 6, "--" + key);
        fail(place, message);
    }
}

void read_gallery(const std::string& file, const std::string& text, GalleryItem& defaults, GalleryRequest& request,
                  GalleryItems& items) {
    const GalleryValue root = read_gallery_toml(file, text);
    const GalleryValue* listed = nullptr;
    for (const auto& [key, value] : root.table) {
        if (key == "item") {
            listed = &value;
        } else if (key == "title") {
            if (value.type != GalleryValue::Type::text) fail(value.place, "title: expected a string");
            if (request.title.empty()) request.title = value.text;
        } else if (key == "poster" || key == "contact") {
            if (value.type != GalleryValue::Type::text)
                fail(value.place, key + ": expected the size of the sheet, such as \"A1\"");
            std::string& size = key == "poster" ? request.poster : request.contact;
            if (size.empty()) {
                size = value.text;
                check_sheet_size(key, size, value.place);
            }
        } else {
            read_gallery_key(key, value, defaults);
        }
    }
    if (!listed) return;
    if (listed->type != GalleryValue::Type::list)
        fail(listed->place, "item: expected one [[item]] table for each item");
    if (listed->list.empty()) fail(listed->place, "item: this list is empty");
    for (const GalleryValue& element : listed->list) {
        if (element.type != GalleryValue::Type::table)
            fail(element.place, "item: expected one [[item]] table for each item");
        GalleryItem item = defaults;
        item.place = element.place;
        item.needs_pattern = true;
        for (const auto& [key, value] : element.table) read_gallery_key(key, value, item);
        items.add(std::move(item));
    }
}

void read_manifest(const std::string& file, std::istream& stream, const GalleryItem& defaults, GalleryItems& items) {
    std::string line;
    std::string place = file + ":1";
    for (std::size_t number = 1; next_line(stream, line, place); place = fmt::format("{}:{}", file, ++number)) {
        if (number % 256 == 0 && interrupted()) throw Interrupted();
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        GalleryItem item = defaults;
        item.place = place + ":1";
        item.needs_pattern = true;
        item.folder = std::filesystem::path(file).parent_path();
        const GalleryValue value = read_manifest_line(place, line);
        for (const auto& [key, element] : value.table) read_gallery_key(key, element, item);
        items.add(std::move(item));
    }
}

}  // namespace sikku
