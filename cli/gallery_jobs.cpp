#include "cli/gallery_jobs.h"

#include "cli/gallery_summary.h"
#include "cli/json.h"

#include "art/style.h"
#include "engine/text.h"

#include <fmt/format.h>
#include <fnmatch.h>
#include <glob.h>

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <unordered_map>

namespace sikku {
namespace {

enum class Use { any, print, score };
enum class Kind { text, number, whole, flag };

struct KeyFacts {
    GalleryKey shown;
    Use use = Use::any;
    Kind kind = Kind::text;
    bool overrides = false;  ///< it is a key of the pattern, not an option
    double least = -1e300;
    double most = 1e300;
};

const std::vector<KeyFacts>& all_keys() {
    static const std::vector<KeyFacts> keys = [] {
        std::vector<KeyFacts> list = {
            {{"n", "Derivation length, or a range of them: 1:6", false, true}, Use::any, Kind::whole, false},
            {{"variant", "One of the pattern's variants", false, true}, Use::any, Kind::text, false},
            {{"budget", "Most nodes of a derivation that are visited", false, true},
             Use::any,
             Kind::number,
             false,
             1},
            {{"seed", "Of chance", false, true}, Use::any, Kind::whole, false},
            {{"size", "Of a print: A0 to A6, letter, legal, tabloid, or WIDTHxHEIGHT", false, true},
             Use::print,
             Kind::text,
             false},
            {{"landscape", "The page lies on its side", true, true}, Use::print, Kind::flag, false},
            {{"margin", "On all four sides", false, true}, Use::print, Kind::text, false},
            {{"fit", "Fill the page within its margins (default)", true, true}, Use::print, Kind::flag, false},
            {{"step", "Length of one turtle step on paper", false, true}, Use::print, Kind::text, false},
            {{"rotate", "Degrees anticlockwise", false, true}, Use::print, Kind::number, false},
            {{"mirror", "Left and right exchanged", true, true}, Use::print, Kind::flag, false},
            {{"window", "What of the drawing fills the page: X0,Y0,X1,Y1 in turtle steps", false, true},
             Use::print,
             Kind::text,
             false},
            {{"compression", "Of PNG: 1, quick and large, to 9", false, true}, Use::print, Kind::whole, false, 1, 9},
            {{"dpi", "Pixels an inch of pictures", false, true}, Use::print, Kind::number, false},
            {{"dot-spacing", "Length between two dots of a kolam", false, true}, Use::print, Kind::text, false},
            {{"border", "kaavi: a frame of red earth lines", false, true}, Use::print, Kind::text, false},
            {{"colour-by", "strand: each line in a colour of its own", false, true}, Use::print, Kind::text, false},
            {{"animate", "SVG that draws itself in so many seconds", false, true}, Use::print, Kind::text, false},
            {{"plotter", "Nothing twice, few lifts of the pen", true, true}, Use::print, Kind::flag, false},
            {{"split", "Length of the longest stroke of a plot", false, true}, Use::print, Kind::text, false},
            {{"travel", "Show the ways of the lifted pen", true, true}, Use::print, Kind::flag, false},
            {{"pen-speed", "Drawing, mm a second", false, true}, Use::print, Kind::number, false},
            {{"travel-speed", "Lifted, mm a second", false, true}, Use::print, Kind::number, false},
            {{"lift-time", "Seconds for lifting and lowering the pen", false, true}, Use::print, Kind::number, false},
            {{"profile", "Of G-code: grbl or z", false, true}, Use::print, Kind::text, false},
            {{"gcode-start", "Lines before the first stroke", false, true}, Use::print, Kind::text, false},
            {{"gcode-end", "Lines after the last", false, true}, Use::print, Kind::text, false},
            {{"bleed", "How far the ground goes on beyond the page", false, true}, Use::print, Kind::text, false},
            {{"marks", "Crop marks; PDF", true, true}, Use::print, Kind::flag, false},
            {{"spot", "NAME=COLOUR: an ink of its own; PDF", false, true}, Use::print, Kind::text, false},
            {{"cmyk", "Inks by this ICC profile; TIFF", false, true}, Use::print, Kind::text, false},
            {{"bits", "A channel: 8, or 1; TIFF", false, true}, Use::print, Kind::whole, false, 1, 8},
            {{"screen", "Of one bit: threshold, diffusion, halftone or halftone,LPI", false, true},
             Use::print,
             Kind::text,
             false},
            {{"no-icc", "Pictures without the ICC profile of their colours", true, true},
             Use::print,
             Kind::flag,
             false},
            {{"angle", "The pattern's angle: its define of that name, or its angle increment", false, true},
             Use::any,
             Kind::text,
             true},
            {{"angle-increment", "", false, false}, Use::any, Kind::text, true},
            {{"angle-factor", "", false, false}, Use::any, Kind::text, true},
            {{"heading", "", false, false}, Use::any, Kind::text, true},
            {{"turn", "", false, false}, Use::any, Kind::text, true},
            {{"scale-factor", "", false, false}, Use::print, Kind::text, true},
        };
        for (const std::string_view key : style_keys()) {
            list.push_back({{std::string(key), "As the key of patterns", false, true}, Use::print, Kind::text, true});
        }
        for (const std::string_view key : melody_keys()) {
            list.push_back({{std::string(key), "As of `sikku play`", false, true}, Use::score, Kind::text, false});
        }
        const std::vector<KeyFacts> of_play = {
            {{"from-bar", "Begin at this bar", false, true}, Use::score, Kind::whole, false, 1},
            {{"bars", "So many bars", false, true}, Use::score, Kind::whole, false, 1},
            {{"seconds", "At most so long", false, true}, Use::score, Kind::number, false},
            {{"transpose", "Semitones", false, true}, Use::score, Kind::number, false},
            {{"humanise", "0 to 1: how far from exact a player is", false, true}, Use::score, Kind::number, false},
            {{"midi-format", "1, a track for each voice, or 0", false, true}, Use::score, Kind::whole, false},
            {{"tuning", "Microtones by pitch bend or by the MIDI Tuning Standard: bend, mts", false, true},
             Use::score,
             Kind::text,
             false}};
        list.insert(list.end(), of_play.begin(), of_play.end());
        return list;
    }();
    return keys;
}

const KeyFacts* find_key(std::string_view name) {
    for (const KeyFacts& key : all_keys()) {
        if (key.shown.name == name) return &key;
    }
    return nullptr;
}

/// Formats of prints, then of scores.
constexpr std::array<std::string_view, 12> print_formats = {"svg",  "pdf", "png",  "tif", "tiff",  "jpg",
                                                            "jpeg", "exr", "hpgl", "plt", "gcode", "nc"};
constexpr std::array<std::string_view, 9> score_formats = {"mid", "midi", "musicxml",  "xml", "ly",
                                                           "wav", "flac", "notes.svg", "html"};

bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// A value of a gallery file or a manifest, with its place.
struct Raw {
    enum class Type { text, list, table, other };
    Type type = Type::text;
    std::string text;  ///< numbers and flags too
    std::vector<Raw> list;
    std::vector<std::pair<std::string, Raw>> table;  ///< in the order of the file; a value's place is its key's
    std::string place;
    std::pair<std::uint32_t, std::uint32_t> order{0, 0};
};

[[noreturn]] void fail(const std::string& place, const std::string& message) {
    throw UsageError(place.empty() ? message : place + ": " + message);
}

std::string place_of(const std::string& file, const toml::source_position& position) {
    return fmt::format("{}:{}:{}", file, position.line, position.column);
}

Raw raw_of(const toml::node& node, const std::string& file) {
    Raw raw;
    raw.place = place_of(file, node.source().begin);
    raw.order = {node.source().begin.line, node.source().begin.column};
    if (const auto* text = node.as_string()) {
        raw.text = text->get();
    } else if (const auto* whole = node.as_integer()) {
        raw.text = fmt::format("{}", whole->get());
    } else if (const auto* number = node.as_floating_point()) {
        if (!std::isfinite(number->get())) fail(raw.place, "expected a finite number");
        raw.text = fmt::format("{}", number->get());
        if (raw.text.ends_with(".0")) raw.text.resize(raw.text.size() - 2);
    } else if (const auto* flag = node.as_boolean()) {
        raw.text = flag->get() ? "true" : "false";
    } else if (const auto* array = node.as_array()) {
        raw.type = Raw::Type::list;
        for (const toml::node& element : *array) raw.list.push_back(raw_of(element, file));
    } else if (const auto* table = node.as_table()) {
        raw.type = Raw::Type::table;
        for (const auto& [key, value] : *table) {
            Raw inner = raw_of(value, file);
            inner.place = place_of(file, key.source().begin);
            inner.order = {key.source().begin.line, key.source().begin.column};
            raw.table.emplace_back(std::string(key.str()), std::move(inner));
        }
        std::stable_sort(raw.table.begin(), raw.table.end(),
                         [](const auto& a, const auto& b) { return a.second.order < b.second.order; });
    } else {
        raw.type = Raw::Type::other;
    }
    return raw;
}

/// JSON keeps no places: a key's is where its name first stands in the line.
Raw raw_of(const nlohmann::ordered_json& json, const std::string& place, const std::string& line_place,
           const std::string& line) {
    Raw raw;
    raw.place = place;
    if (json.is_string()) {
        raw.text = json.get<std::string>();
    } else if (json.is_number_float()) {
        raw.text = fmt::format("{}", json.get<double>());
        if (raw.text.ends_with(".0")) raw.text.resize(raw.text.size() - 2);
    } else if (json.is_number() || json.is_boolean()) {
        raw.text = json.dump();
    } else if (json.is_array()) {
        raw.type = Raw::Type::list;
        for (const auto& element : json) raw.list.push_back(raw_of(element, place, line_place, line));
    } else if (json.is_object()) {
        raw.type = Raw::Type::table;
        for (const auto& [key, value] : json.items()) {
            const std::size_t at = line.find('"' + key + '"');
            std::size_t column = 1;
            for (std::size_t i = 0; at != std::string::npos && i < at; ++i) {
                column += (static_cast<unsigned char>(line[i]) & 0xC0) != 0x80 ? 1 : 0;
            }
            raw.table.emplace_back(key, raw_of(value, fmt::format("{}:{}", line_place, column), line_place, line));
        }
    } else {
        raw.type = Raw::Type::other;
    }
    return raw;
}

/// `60:90:5`, not written out.
struct Stretch {
    double first = 0;
    double step = 1;
    double count = 1;

    std::string value(std::uint64_t index) const {
        // Twelve digits, so that 0.1 + 0.2 is 0.3.
        std::string text = fmt::format("{:.12g}", first + static_cast<double>(index) * step);
        return text == "-0" ? "0" : text;
    }
};

/// `A:B` or `A:B:STEP`; nullopt for what is none.
std::optional<Stretch> read_stretch(const std::string& key, const std::string& text, const std::string& place) {
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
    Stretch stretch{numbers[0], numbers.size() == 3 ? numbers[2] : 1.0, 0};
    const double steps = (numbers[1] - stretch.first) / stretch.step;
    if (stretch.step == 0 || !(steps >= 0)) {
        fail(place, fmt::format("{}: the range {} holds nothing", key, printable(text, 80)));
    }
    stretch.count = std::floor(steps + 1e-9) + 1;
    return stretch;
}

/// A key and the values it takes one after the other.
struct Axis {
    std::string key;
    std::string place;
    std::vector<std::string> values;
    std::optional<Stretch> stretch;  ///< instead of values
    bool in_set = false;

    double count() const { return stretch ? stretch->count : static_cast<double>(values.size()); }
    std::string value(std::uint64_t index) const { return stretch ? stretch->value(index) : values[index]; }
};

/// What is asked for together.
struct Item {
    std::string place;
    bool needs_pattern = false;
    std::filesystem::path folder;
    std::vector<std::string> patterns;
    std::string patterns_place;
    std::vector<std::string> formats;
    std::string formats_place;
    std::optional<std::string> name;
    std::string name_place;
    std::vector<Axis> axes;

    void drop(std::string_view key) {
        std::erase_if(axes, [&](const Axis& axis) { return axis.key == key && !axis.in_set; });
    }
    void take(Axis axis) {
        for (Axis& old : axes) {
            if (old.key == axis.key && old.in_set == axis.in_set) {
                old = std::move(axis);
                return;
            }
        }
        axes.push_back(std::move(axis));
    }
};

std::vector<std::string> words_of(const Raw& raw, std::string_view key) {
    std::vector<std::string> words;
    if (raw.type == Raw::Type::text) {
        words.push_back(raw.text);
    } else if (raw.type == Raw::Type::list) {
        for (const Raw& element : raw.list) {
            if (element.type != Raw::Type::text) fail(element.place, fmt::format("{}: expected a text", key));
            words.push_back(element.text);
        }
    } else {
        fail(raw.place, fmt::format("{}: expected a text or a list of texts", key));
    }
    if (words.empty()) fail(raw.place, fmt::format("{}: this list is empty", key));
    return words;
}

bool is_whole(const std::string& text) {
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && stop == text.data() + text.size();
}

/// @param facts  null: of a key of the pattern's own
void check_value(const std::string& key, const KeyFacts* facts, const std::string& value, const std::string& place) {
    if (!fits_xml(value)) fail(place, fmt::format("{}: '{}' is no UTF-8 text", key, printable(value, 80)));
    if (!facts) return;
    const Kind kind = facts->kind;
    double number = 0;
    const bool is_number = read_number(value, number);
    if (kind == Kind::number && !is_number) {
        fail(place, fmt::format("{}: expected a number, not '{}'", key, printable(value, 80)));
    }
    if (kind == Kind::whole && !is_whole(value)) {
        fail(place, fmt::format("{}: expected a whole number, 0 or more, not '{}'", key, printable(value, 80)));
    }
    if (kind == Kind::flag && value != "true" && value != "false") {
        fail(place, fmt::format("{}: expected true or false, not '{}'", key, printable(value, 80)));
    }
    if ((kind == Kind::number || kind == Kind::whole) && number < facts->least) {
        fail(place, fmt::format("{}: expected {:g} or more, not '{}'", key, facts->least, printable(value, 80)));
    }
    if ((kind == Kind::number || kind == Kind::whole) && number > facts->most) {
        fail(place, fmt::format("{}: expected {:g} at most, not '{}'", key, facts->most, printable(value, 80)));
    }
}

/// @param facts  null: of a key of the pattern's own, in `set`
Axis axis_of(const std::string& key, const Raw& raw, const KeyFacts* facts) {
    Axis axis{key, raw.place, {}, std::nullopt, facts == nullptr};
    const std::vector<std::string> words = words_of(raw, key);
    // These may hold a colon.
    const bool is_prose = !facts && (key == "title" || key == "source" || key == "description");
    for (const std::string& word : words) {
        const auto stretch = is_prose ? std::nullopt : read_stretch(key, word, raw.place);
        if (!stretch) {
            check_value(key, facts, word, raw.place);
            axis.values.push_back(word);
            continue;
        }
        if (facts && facts->kind == Kind::flag) check_value(key, facts, word, raw.place);
        if (facts && facts->kind == Kind::whole) {
            const auto is_whole_number = [](double value) {
                return value >= 0 && value == std::floor(value) && value < 1e11;
            };
            const double last = stretch->first + (stretch->count - 1) * stretch->step;
            if (!is_whole_number(stretch->first) || stretch->step != std::floor(stretch->step) ||
                (stretch->count < most_gallery_jobs && !is_whole_number(last))) {
                fail(raw.place, fmt::format("{}: expected whole numbers, 0 or more", key));
            }
        }
        if (words.size() == 1) {
            axis.stretch = stretch;
            break;
        }
        if (!(static_cast<double>(axis.values.size()) + stretch->count <= most_gallery_jobs)) {
            fail(raw.place, fmt::format("{}: there are too many values in {}", key, printable(word, 80)));
        }
        for (std::uint64_t i = 0; static_cast<double>(i) < stretch->count; ++i) {
            axis.values.push_back(stretch->value(i));
        }
    }
    if (axis.stretch && facts) {
        check_value(key, facts, axis.stretch->value(0), raw.place);
        if (axis.stretch->count <= most_gallery_jobs) {
            check_value(key, facts, axis.stretch->value(static_cast<std::uint64_t>(axis.stretch->count) - 1),
                        raw.place);
        }
    }
    return axis;
}

/// As keys are compared: `from_bar` and `from bar` are `from-bar`; several forms of one are one.
std::string folded_key(std::string key) {
    for (char& letter : key) {
        if (letter == '_' || letter == ' ') letter = '-';
    }
    if (key == "generations" || key == "steps") return "n";
    if (key == "seeds" || key == "formats" || key == "patterns") key.pop_back();
    return key;
}

void check_format(const std::string& format, const std::string& place) {
    if (is_one_of(format, print_formats) || is_one_of(format, score_formats)) return;
    std::vector<std::string_view> known(print_formats.begin(), print_formats.end());
    known.insert(known.end(), score_formats.begin(), score_formats.end());
    const std::string_view near = nearest(format, known);
    fail(place, fmt::format("there is no format '{}'{}", printable(format, 80),
                            near.empty() ? fmt::format("; there are {}", fmt::join(known, ", "))
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
            formats.push_back(format);
            at = comma + 1;
        }
    }
    return formats;
}

void read_key(const std::string& written, const Raw& raw, Item& item) {
    const std::string key = folded_key(written);
    if (key == "pattern") {
        item.patterns = words_of(raw, key);
        item.patterns_place = raw.place;
    } else if (key == "format") {
        item.formats = read_formats(words_of(raw, key), raw.place);
        item.formats_place = raw.place;
    } else if (key == "name") {
        if (raw.type != Raw::Type::text) fail(raw.place, "name: expected a text");
        item.name = raw.text;
        item.name_place = raw.place;
    } else if (key == "set") {
        if (raw.type != Raw::Type::table) fail(raw.place, "set: expected a table such as { r = 0.5 }");
        for (const auto& [name, value] : raw.table) item.take(axis_of(name, value, nullptr));
    } else if (const KeyFacts* facts = find_key(key)) {
        item.take(axis_of(key, raw, facts));
    } else {
        std::vector<std::string_view> known = {"pattern", "format", "name",    "set",  "generations",
                                               "item",    "poster", "contact", "title"};
        for (const KeyFacts& each : all_keys()) known.push_back(each.shown.name);
        const std::string_view near = nearest(key, known);
        fail(raw.place, fmt::format("nobody knows the key '{}'{}", printable(written, 80),
                                    near.empty() ? "; keys and defines of patterns go into `set = { … }`"
                                                 : fmt::format("; did you mean '{}'?", near)));
    }
}

std::string read_text_file(const std::string& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) throw UsageError(fmt::format("{} is a folder", file));
    std::ifstream stream(file, std::ios::binary);
    if (!stream.is_open()) throw UsageError(fmt::format("{}: {}", file, std::generic_category().message(errno)));
    constexpr std::size_t most_bytes = std::size_t{1} << 28;
    std::string text;
    for (std::array<char, 65536> block{}; stream && text.size() <= most_bytes;) {
        stream.read(block.data(), block.size());
        text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    }
    if (stream.bad()) throw UsageError(fmt::format("{}: {}", file, std::generic_category().message(errno)));
    if (text.size() > most_bytes) throw UsageError(fmt::format("{}: over 256 MB", file));
    return text;
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

/// The defaults go into `defaults`; title and sizes of sheets into `request`, unless it has them already.
std::vector<Item> read_gallery_file(const std::string& file, Item& defaults, GalleryRequest& request) {
    Raw root;
    try {
        root = raw_of(toml::parse(read_text_file(file), file), file);
    } catch (const toml::parse_error& error) {
        fail(place_of(file, error.source().begin), printable(error.description(), 300));
    }
    const Raw* items = nullptr;
    defaults.folder = std::filesystem::path(file).parent_path();
    defaults.place = file + ":1:1";
    for (const auto& [key, value] : root.table) {
        if (key == "item") {
            items = &value;
        } else if (key == "title") {
            if (value.type != Raw::Type::text) fail(value.place, "title: expected a text");
            if (request.title.empty()) request.title = value.text;
        } else if (key == "poster" || key == "contact") {
            if (value.type != Raw::Type::text)
                fail(value.place, key + ": expected the size of the sheet, such as \"A1\"");
            std::string& size = key == "poster" ? request.poster : request.contact;
            if (size.empty()) {
                size = value.text;
                check_sheet_size(key, size, value.place);
            }
        } else {
            read_key(key, value, defaults);
        }
    }
    std::vector<Item> list;
    if (!items) return list;
    if (items->type != Raw::Type::list) fail(items->place, "item: write it as [[item]], one for each");
    if (items->list.empty()) fail(items->place, "item: this list is empty");
    for (const Raw& element : items->list) {
        if (element.type != Raw::Type::table) fail(element.place, "item: write it as [[item]], one for each");
        Item item = defaults;
        item.place = element.place;
        item.needs_pattern = true;
        for (const auto& [key, value] : element.table) read_key(key, value, item);
        list.push_back(std::move(item));
    }
    return list;
}

std::vector<Item> read_manifest(const std::string& file, const Item& defaults) {
    std::vector<Item> list;
    const std::string text = read_text_file(file);
    std::size_t number = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        at = end + 1;
        ++number;
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        const std::string line_place = fmt::format("{}:{}", file, number);
        nlohmann::ordered_json json;
        try {
            json = read_json(line);
        } catch (const JsonError& error) {
            fail(fmt::format("{}:{}", line_place, error.byte), error.what());
        }
        if (!json.is_object()) fail(line_place + ":1", "expected a job: { \"pattern\": … }");
        Item item = defaults;
        item.place = line_place + ":1";
        item.needs_pattern = true;
        item.folder = std::filesystem::path(file).parent_path();
        const Raw raw = raw_of(json, item.place, line_place, line);
        for (const auto& [key, value] : raw.table) read_key(key, value, item);
        list.push_back(std::move(item));
    }
    return list;
}

bool has_wildcards(std::string_view word) {
    return word.find_first_of("*?[") != std::string_view::npos;
}

/// As a glob that fits nothing else.
std::string without_wildcards(const std::string& text) {
    std::string form;
    for (const char letter : text) {
        if (has_wildcards({&letter, 1}) || letter == '\\') form += '\\';
        form += letter;
    }
    return form;
}

/// Finds patterns and reads each once.
class PatternShelf {
public:
    using Pointer = std::shared_ptr<const GalleryPattern>;

    std::vector<Pointer> find(const std::string& word, const std::filesystem::path& folder,
                              const std::string& place) {
        std::vector<Pointer> found;
        if (word == "-") fail(place, "a gallery reads no pattern from standard input");
        const std::filesystem::path path = folder / word;
        std::error_code error;
        const bool is_folder = std::filesystem::is_directory(path, error);
        if (is_folder) {
            std::vector<std::filesystem::path> files;
            for (std::filesystem::recursive_directory_iterator entry(path, error), end; !error && entry != end;
                 entry.increment(error)) {
                if (entry->path().extension() == ".lsys") files.push_back(entry->path());
            }
            if (error) fail(place, fmt::format("{}: {}", path.string(), error.message()));
            std::sort(files.begin(), files.end());
            for (const auto& file : files) found.push_back(of_file(file));
        } else if (std::filesystem::exists(path, error)) {
            found.push_back(of_file(path));
        } else if (has_wildcards(word)) {
            glob_t matches{};
            const std::string form = (std::filesystem::path(without_wildcards(folder.string())) / word).string();
            if (glob(form.c_str(), 0, nullptr, &matches) == 0) {
                for (std::size_t i = 0; i < matches.gl_pathc; ++i) {
                    const std::filesystem::path match = matches.gl_pathv[i];
                    if (match.extension() == ".lsys") found.push_back(of_file(match));
                }
            }
            globfree(&matches);
        }
        if (!found.empty()) return found;
        // The folder of a gallery may be called as a kind is.
        for (const KnownPattern& pattern : known()) {
            const std::string full = pattern.kind + "/" + pattern.name;
            const bool is_full = word.find('/') != std::string::npos;
            if (pattern.kind == word || fnmatch(word.c_str(), (is_full ? full : pattern.name).c_str(), 0) == 0) {
                found.push_back(of_known(pattern));
            }
        }
        if (!found.empty()) return found;
        if (is_folder) fail(place, fmt::format("{}: there is no pattern in this folder", path.string()));
        if (has_wildcards(word)) fail(place, fmt::format("no pattern fits '{}'", printable(word, 80)));
        std::vector<std::string_view> names;
        for (const KnownPattern& pattern : known()) names.push_back(pattern.name);
        const std::string_view near = nearest(word, names);
        fail(place, fmt::format("there is no file and no pattern '{}'{}", printable(word, 80),
                                near.empty() ? "; `sikku patterns` lists those that come along"
                                             : fmt::format("; did you mean '{}'?", near)));
    }

    /// All that come along and draw.
    std::vector<Pointer> all() {
        std::vector<Pointer> found;
        for (const KnownPattern& pattern : known()) {
            if (pattern.kind != "words") found.push_back(of_known(pattern));
        }
        if (found.empty()) throw UsageError("no patterns were found");
        return found;
    }

private:
    const std::vector<KnownPattern>& known() {
        if (!is_listed_) known_ = known_patterns();
        is_listed_ = true;
        return known_;
    }

    Pointer of_known(const KnownPattern& known) { return read(known.file, known.name, known.name + ".lsys"); }

    Pointer of_file(const std::filesystem::path& file) { return read(file, file.string(), file.string()); }

    Pointer read(const std::filesystem::path& file, const std::string& shown, const std::string& called) {
        Pointer& known = read_[file.string()];
        if (known) return known;
        GalleryPattern pattern;
        pattern.name = file.stem().string();
        pattern.kind = file.parent_path().filename().string();
        pattern.path = file.string();
        pattern.shown = shown;
        try {
            pattern.text = std::make_shared<PatternText>(PatternText{called, read_pattern_text(file.string()).text});
        } catch (const UsageError& error) {
            pattern.problem = error.what();
        }
        known = std::make_shared<const GalleryPattern>(std::move(pattern));
        return known;
    }

    bool is_listed_ = false;
    std::vector<KnownPattern> known_;
    std::map<std::string, Pointer> read_;
};

/// As part of a file's name.
std::string name_part(std::string_view value) {
    std::string part;
    for (const char letter : value) {
        const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '.' || letter == '_' ||
                           letter == '+' || letter == '-' || (static_cast<unsigned char>(letter) & 0x80) != 0;
        if (plain) {
            part += letter;
        } else if (!part.empty() && part.back() != '-') {
            part += '-';
        }
    }
    while (part.ends_with('-')) part.pop_back();
    return part;
}

/// Makes the jobs of items.
class Expansion {
public:
    explicit Expansion(std::vector<Item> items) : items_(std::move(items)) {
        for (const Item& item : items_) patterns_.push_back(patterns_of(item));
    }

    /// Of all items, before anything is written out.
    /// @throws UsageError if they are too many
    void require_few() const {
        double sum = 0;
        for (std::size_t i = 0; i < items_.size(); ++i) {
            for (const auto& pattern : patterns_[i]) {
                for (const std::string& format : formats_of(items_[i], *pattern)) {
                    double product = 1;
                    for (const Axis& axis : items_[i].axes) product *= matters(axis, format) ? axis.count() : 1;
                    sum += product;
                }
            }
            if (sum > most_gallery_jobs) {
                fail(items_[i].place,
                     fmt::format("this would make {} jobs; at most {:.0f} are made at a time",
                                 sum < 1e15 ? fmt::format("{:.0f}", sum) : fmt::format("{:.0e}", sum),
                                 most_gallery_jobs));
            }
        }
    }

    std::vector<GalleryJob> jobs() {
        std::vector<GalleryJob> list;
        for (std::size_t i = 0; i < items_.size(); ++i) {
            for (const auto& pattern : patterns_[i]) {
                for (const std::string& format : formats_of(items_[i], *pattern)) {
                    expand(items_[i], pattern, format, list);
                }
            }
        }
        std::unordered_map<std::string, const GalleryJob*> names;
        for (const GalleryJob& job : list) {
            const auto [known, is_new] = names.emplace(job.file(), &job);
            if (is_new) continue;
            const std::string& other = known->second->place;
            fail(job.place, fmt::format("two jobs are named '{}'{}; `name` can tell them apart", job.file(),
                                        other.empty() || other == job.place ? "" : " (the other: " + other + ")"));
        }
        return list;
    }

private:
    std::vector<PatternShelf::Pointer> patterns_of(const Item& item) {
        if (item.patterns.empty()) {
            if (item.needs_pattern) fail(item.place, "this item has no pattern");
            return shelf_.all();
        }
        std::vector<PatternShelf::Pointer> found;
        std::set<const GalleryPattern*> seen;
        for (const std::string& word : item.patterns) {
            for (const auto& pattern : shelf_.find(word, item.folder, item.patterns_place)) {
                if (seen.insert(pattern.get()).second) found.push_back(pattern);
            }
        }
        return found;
    }

    static std::vector<std::string> formats_of(const Item& item, const GalleryPattern& pattern) {
        if (!item.formats.empty()) return item.formats;
        if (pattern.kind == "melodies") return {"svg", "mid"};
        return {"svg"};
    }

    static bool matters(const Axis& axis, const std::string& format) {
        if (axis.in_set) return true;
        const Use use = find_key(axis.key)->use;
        return use == Use::any || (use == Use::score) == is_one_of(format, score_formats);
    }

    /// The key of the pattern that `angle` stands for.
    std::string override_key(const std::string& key, const GalleryPattern& pattern) {
        if (key == "angle") {
            const auto [known, is_new] = defines_angle_.emplace(&pattern, true);
            if (is_new && pattern.text) {
                Diagnostics ignored;
                const Pattern parsed = parse_pattern(pattern.text->name, pattern.text->text, ignored);
                known->second = std::any_of(parsed.defines.begin(), parsed.defines.end(),
                                            [](const Define& define) { return define.name.view() == "angle"; });
            }
            return known->second ? key : "angle increment";
        }
        std::string name = key;
        std::replace(name.begin(), name.end(), '-', ' ');
        return name;
    }

    void expand(const Item& item, const PatternShelf::Pointer& pattern, const std::string& format,
                std::vector<GalleryJob>& list) {
        std::vector<const Axis*> axes;
        std::vector<std::string> targets;  // the pattern's key, where an axis sets one
        for (const Axis& axis : item.axes) {
            if (!matters(axis, format)) continue;
            axes.push_back(&axis);
            const bool overrides = !axis.in_set && find_key(axis.key)->overrides;
            targets.push_back(axis.in_set ? axis.key : overrides ? override_key(axis.key, *pattern) : "");
        }
        std::vector<std::uint64_t> at(axes.size(), 0);
        while (true) {
            GalleryJob job = job_at(item, pattern, format, axes, targets, at, axes.size());
            job.name = name_of(item, job, axes, at);
            check(item, job);
            // Mistakes in values: of each axis all, the others at their first, and of ranges the ends.
            const auto others = std::count_if(at.begin(), at.end(), [](std::uint64_t value) { return value > 0; });
            if (others < 2 && is_sound(pattern)) {
                std::size_t axis = 0;
                while (axis + 1 < axes.size() && at[axis] == 0) ++axis;
                const bool is_end = axes.empty() || !axes[axis]->stretch || at[axis] == 0 ||
                                    static_cast<double>(at[axis] + 1) >= axes[axis]->count();
                const std::string problem = is_end ? problem_of(job) : "";
                for (std::size_t without = 0; !problem.empty() && without < axes.size(); ++without) {
                    if (problem_of(job_at(item, pattern, format, axes, targets, at, without)).empty()) {
                        fail(axes[without]->place.empty() ? job.place : axes[without]->place, problem);
                    }
                }
                if (!problem.empty()) fail(job.place, problem);
            }
            list.push_back(std::move(job));
            // The last axis runs fastest.
            std::size_t axis = axes.size();
            while (axis > 0 && static_cast<double>(++at[axis - 1]) >= axes[axis - 1]->count()) at[--axis] = 0;
            if (axis == 0) return;
        }
    }

    /// @param without  an axis that does not count
    static GalleryJob job_at(const Item& item, const PatternShelf::Pointer& pattern, const std::string& format,
                             const std::vector<const Axis*>& axes, const std::vector<std::string>& targets,
                             const std::vector<std::uint64_t>& at, std::size_t without) {
        GalleryJob job;
        job.format = format;
        job.pattern = pattern;
        job.place = item.place;
        job.folder = item.folder;
        for (std::size_t i = 0; i < axes.size(); ++i) {
            if (i == without) continue;
            const std::string value = axes[i]->value(at[i]);
            if (!targets[i].empty()) {
                job.overrides[targets[i]] = value;
            } else if (value != "false" || find_key(axes[i]->key)->kind != Kind::flag) {
                job.keys[axes[i]->key] = value;
            }
        }
        return job;
    }

    /// Whether the pattern can be compiled as it is: else its jobs tell what is wrong with it.
    bool is_sound(const PatternShelf::Pointer& pattern) {
        const auto [known, is_new] = is_sound_.emplace(pattern.get(), false);
        if (is_new) {
            GalleryJob plain;
            plain.format = "svg";
            plain.pattern = pattern;
            known->second = pattern->text && problem_of(plain).empty();
        }
        return known->second;
    }

    static std::string problem_of(const GalleryJob& job) {
        try {
            load(job.is_score() ? score_settings(job, "x.mid").pattern : print_settings(job, "x.svg").pattern, true);
        } catch (const std::runtime_error& error) {
            std::string message = error.what();
            while (message.ends_with('\n')) message.pop_back();
            return message.empty() ? "this does not go with the pattern" : message;
        }
        return "";
    }

    std::string name_of(const Item& item, const GalleryJob& job, const std::vector<const Axis*>& axes,
                        const std::vector<std::uint64_t>& at) {
        std::string name;
        if (!item.name) {
            name = name_part(job.pattern->name);
            if (job.keys.contains("variant")) name += "-" + name_part(job.keys.at("variant"));
            for (std::size_t i = 0; i < axes.size(); ++i) {
                if (axes[i]->count() < 2 || axes[i]->key == "variant") continue;
                name += fmt::format("-{}{}", name_part(axes[i]->key), name_part(axes[i]->value(at[i])));
            }
        } else {
            const std::string& form = *item.name;
            for (std::size_t i = 0; i < form.size();) {
                if (form[i] != '{') {
                    name += form[i++];
                    continue;
                }
                const std::size_t end = form.find('}', i);
                if (end == std::string::npos) fail(item.name_place, "name: '{' without '}'");
                name += name_part(placeholder(item, job, axes, at, form.substr(i + 1, end - i - 1)));
                i = end + 1;
            }
        }
        const std::string file = name + "." + job.format;
        const bool has_controls = std::any_of(name.begin(), name.end(),
                                              [](char letter) { return static_cast<unsigned char>(letter) < ' '; });
        // Parts of a path that are empty, hidden, or lead elsewhere.
        const std::string path = "/" + name + "/";
        if (name.empty() || path.find("//") != std::string::npos || path.find("/.") != std::string::npos ||
            is_summary(file) || has_controls || !fits_xml(name) || file.size() > 1000) {
            fail(item.name_place.empty() ? item.place : item.name_place,
                 fmt::format("name: '{}' cannot be the name of an output", printable(name, 80)));
        }
        return name;
    }

    std::string placeholder(const Item& item, const GalleryJob& job, const std::vector<const Axis*>& axes,
                            const std::vector<std::uint64_t>& at, const std::string& written) {
        if (written == "pattern") return job.pattern->name;
        if (written == "kind") return job.pattern->kind;
        if (written == "format") return job.format;
        const std::string key = folded_key(written);
        for (std::size_t i = 0; i < axes.size(); ++i) {
            if (axes[i]->key == key || axes[i]->key == written) return axes[i]->value(at[i]);
        }
        if (key == "n") return derivation_length(job);
        for (const Axis& axis : item.axes) {
            if (axis.key == key || axis.key == written) return axis.value(0);
        }
        if (const KeyFacts* facts = find_key(key); facts) return "";
        std::vector<std::string_view> known = {"pattern", "kind", "format", "n"};
        for (const Axis& axis : item.axes) known.push_back(axis.key);
        const std::string_view near = nearest(written, known);
        fail(item.name_place, fmt::format("name: nobody knows {{{}}}{}", printable(written, 80),
                                          near.empty() ? fmt::format("; there are {}", fmt::join(known, ", "))
                                                       : fmt::format("; did you mean {{{}}}?", near)));
    }

    /// The pattern's own, with what the job changes in it.
    std::string derivation_length(const GalleryJob& job) {
        try {
            const LoadedPattern loaded = load(print_settings(job, "x.svg").pattern, true);
            return fmt::format("{}", loaded.grammar.steps());
        } catch (const std::exception&) {
            return "";  // the job itself tells why
        }
    }

    static void check(const Item& item, const GalleryJob& job) {
        try {
            if (job.is_score()) {
                check_score(score_settings(job, job.file()));
            } else {
                if (job.keys.contains("step") && job.keys.contains("fit")) {
                    throw UsageError("step: a print has a step or fits its page, not both");
                }
                plan_print(print_settings(job, job.file()));
            }
        } catch (const UsageError& error) {
            // Of a single option, where that was said.
            const std::string message = error.what();
            for (const Axis& axis : item.axes) {
                const bool is_option = message.starts_with("--" + axis.key) || message.starts_with(axis.key + ":");
                if (is_option && !axis.place.empty()) fail(axis.place, message);
            }
            fail(job.place, message);
        }
    }

    std::vector<Item> items_;
    PatternShelf shelf_;
    std::map<const GalleryPattern*, bool> defines_angle_;
    std::map<const GalleryPattern*, bool> is_sound_;
    std::vector<std::vector<PatternShelf::Pointer>> patterns_;
};

double number_of(const GalleryJob& job, const char* key, double otherwise) {
    const auto found = job.keys.find(key);
    double value = otherwise;
    if (found != job.keys.end()) read_number(found->second, value);
    return value;
}

template <typename Whole>
void whole_of(const GalleryJob& job, const char* key, Whole& value) {
    const auto found = job.keys.find(key);
    if (found == job.keys.end()) return;
    const std::string& text = found->second;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc()) {
        throw UsageError(fmt::format("{}: {} is too large", key, text));
    }
}

PatternOptions pattern_options(const GalleryJob& job) {
    PatternOptions options;
    options.pattern = job.pattern->path;
    options.text = job.pattern->text;
    if (job.keys.contains("n")) options.steps = job.keys.at("n");
    if (job.keys.contains("variant")) options.variant = job.keys.at("variant");
    for (const auto& [key, value] : job.overrides) options.settings.push_back(key + "=" + value);
    if (job.keys.contains("seed")) options.settings.push_back("seed=" + job.keys.at("seed"));
    return options;
}

/// The kinds of the patterns, `Kolams, curves`, if they are few.
std::string title_of(const std::vector<GalleryJob>& jobs) {
    std::vector<std::string> kinds;
    for (const GalleryJob& job : jobs) {
        const std::string& kind = job.pattern->kind;
        if (!kind.empty() && std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
        if (kinds.size() > 3) return "Sikku";
    }
    std::string title = fmt::format("{}", fmt::join(kinds, ", "));
    if (title.empty()) return "Sikku";
    title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
    return title;
}

/// What was asked for on the command line goes before what a file says.
void take_request(const GalleryRequest& request, Item& item) {
    if (request.keys.contains("fit")) item.drop("step");
    if (request.keys.contains("step")) item.drop("fit");
    for (const auto& [key, value] : request.keys) {
        Raw raw;
        raw.text = value;
        if (key == "format" || key == "name") {
            read_key(key, raw, item);
        } else {
            item.take(axis_of(key, raw, find_key(key)));
        }
    }
    for (const std::string& text : request.overrides) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw UsageError(fmt::format("--set {}: expected KEY=VALUE", text));
        }
        Raw raw;
        raw.text = text.substr(equals + 1);
        item.take(axis_of(text.substr(0, equals), raw, nullptr));
    }
}

}  // namespace

const std::vector<GalleryKey>& gallery_keys() {
    static const std::vector<GalleryKey> keys = [] {
        std::vector<GalleryKey> list;
        for (const KeyFacts& key : all_keys()) list.push_back(key.shown);
        return list;
    }();
    return keys;
}

bool GalleryJob::is_score() const {
    return is_one_of(format, score_formats);
}

std::string GalleryJob::text() const {
    nlohmann::json json;
    json["name"] = name;
    json["format"] = format;
    json["pattern"] = pattern->shown;
    for (const auto& [key, value] : keys) json[key] = value;
    for (const auto& [key, value] : overrides) json["set"][key] = value;
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string GalleryJob::hash() const {
    TextHash hash;
    hash.add_piece(SIKKU_VERSION);
    hash.add_piece(format);
    hash.add_piece(pattern->text ? pattern->text->text : "");
    for (const auto& [key, value] : keys) {
        if (key == "budget") continue;  // it says whether there is a file, not what is in it
        hash.add_piece(key);
        hash.add_piece(value);
    }
    hash.add_piece("");
    for (const auto& [key, value] : overrides) {
        hash.add_piece(key);
        hash.add_piece(value);
    }
    if (is_score() && pattern->text) {
        const std::string whole = text() + pattern->text->text;
        if (whole.find(".scl") != std::string::npos || whole.find(".kbm") != std::string::npos) {
            for (const auto& [file, held] : scala_files(score_settings(*this, "x.mid"))) {
                hash.add_piece(file);
                hash.add_piece(held);
            }
        }
    }
    return hash.digits();
}

DrawSettings print_settings(const GalleryJob& job, const std::filesystem::path& output) {
    DrawSettings settings;
    settings.pattern = pattern_options(job);
    settings.output = output.string();
    const auto text = [&](const char* key, std::string& value) {
        if (job.keys.contains(key)) value = job.keys.at(key);
    };
    text("size", settings.size);
    text("margin", settings.margin);
    if (job.keys.contains("step") && !job.keys.contains("fit")) settings.step = job.keys.at("step");
    if (job.keys.contains("window")) settings.window = job.keys.at("window");
    whole_of(job, "compression", settings.compression);
    const auto optional = [&](const char* key, std::optional<std::string>& value) {
        if (job.keys.contains(key)) value = job.keys.at(key);
    };
    optional("dot-spacing", settings.dot_spacing);
    optional("animate", settings.animate);
    optional("gcode-start", settings.gcode_start);
    optional("gcode-end", settings.gcode_end);
    text("border", settings.border);
    text("colour-by", settings.colour_by);
    text("split", settings.split);
    text("profile", settings.profile);
    text("bleed", settings.bleed);
    text("cmyk", settings.cmyk);
    text("screen", settings.screen);
    if (job.keys.contains("spot")) settings.spots = {job.keys.at("spot")};
    whole_of(job, "bits", settings.bits);
    settings.plotter = job.keys.contains("plotter");
    settings.travel = job.keys.contains("travel");
    settings.marks = job.keys.contains("marks");
    settings.icc = !job.keys.contains("no-icc");
    settings.speeds.drawing = number_of(job, "pen-speed", settings.speeds.drawing);
    settings.speeds.travelling = number_of(job, "travel-speed", settings.speeds.travelling);
    settings.speeds.lift = number_of(job, "lift-time", settings.speeds.lift);
    settings.landscape = job.keys.contains("landscape");
    settings.mirror = job.keys.contains("mirror");
    settings.rotate = number_of(job, "rotate", settings.rotate);
    settings.dpi = number_of(job, "dpi", settings.dpi);
    settings.budget = number_of(job, "budget", settings.budget);
    settings.threads = 1;
    return settings;
}

PlaySettings score_settings(const GalleryJob& job, const std::filesystem::path& output) {
    PlaySettings settings;
    settings.pattern = pattern_options(job);
    settings.patterns = {job.pattern->path};
    settings.output = output.string();
    settings.folder = job.folder;
    const auto keys = melody_keys();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const auto found = job.keys.find(std::string(keys[i]));
        if (found != job.keys.end()) settings.keys[i] = found->second;
    }
    whole_of(job, "from-bar", settings.from_bar);
    if (settings.from_bar < 1) throw UsageError("from-bar: bars are counted from 1");
    whole_of(job, "bars", settings.bars);
    whole_of(job, "seed", settings.seed);
    whole_of(job, "midi-format", settings.format);
    if (settings.format != 0 && settings.format != 1) throw UsageError("midi-format: expected 0 or 1");
    settings.seconds = number_of(job, "seconds", settings.seconds);
    settings.transpose = number_of(job, "transpose", settings.transpose);
    settings.humanise = number_of(job, "humanise", settings.humanise);
    settings.budget = number_of(job, "budget", settings.budget);
    if (job.keys.contains("tuning")) settings.tuning = job.keys.at("tuning");
    if (settings.tuning != "bend" && settings.tuning != "mts") throw UsageError("tuning: expected bend or mts");
    return settings;
}

std::vector<GalleryJob> gallery_jobs(GalleryRequest& request) {
    Item defaults;
    std::vector<Item> items;
    if (!request.poster.empty()) check_sheet_size("poster", request.poster, "");
    if (!request.contact.empty()) check_sheet_size("contact", request.contact, "");
    if (!request.gallery_file.empty()) items = read_gallery_file(request.gallery_file, defaults, request);
    if (!request.manifest.empty()) {
        std::vector<Item> more = read_manifest(request.manifest, defaults);
        items.insert(items.end(), more.begin(), more.end());
    }
    if (!request.patterns.empty()) {
        // Seen from here, not from the gallery file.
        Item item = defaults;
        item.folder.clear();
        item.place.clear();
        item.patterns_place.clear();
        item.patterns = request.patterns;
        items.push_back(std::move(item));
    } else if (items.empty() && request.manifest.empty()) {
        items.push_back(defaults);
    }
    for (Item& item : items) take_request(request, item);
    Expansion expansion(std::move(items));
    expansion.require_few();
    std::vector<GalleryJob> jobs = expansion.jobs();
    if (request.title.empty()) request.title = title_of(jobs);
    return jobs;
}

void TextHash::add(std::string_view bytes) {
    __extension__ using Wide = unsigned __int128;
    constexpr Wide prime = (Wide{1} << 88) + 0x13b;
    Wide state = (Wide{high_} << 64) | low_;
    for (const char byte : bytes) state = (state ^ static_cast<unsigned char>(byte)) * prime;
    high_ = static_cast<std::uint64_t>(state >> 64);
    low_ = static_cast<std::uint64_t>(state);
}

void TextHash::add_piece(std::string_view bytes) {
    add(fmt::format("{}:", bytes.size()));
    add(bytes);
}

std::string TextHash::digits() const {
    return fmt::format("{:016x}{:016x}", high_, low_);
}

}  // namespace sikku
