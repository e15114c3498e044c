#include "art/gallery/items.h"

#include "art/product/draw_settings.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>

namespace sikku {
namespace {

/// Maximum number of keys with values, in all items together.
constexpr std::size_t most_settings = 10'000'000;
constexpr std::size_t longest_item_line = std::size_t{16} << 20;

/// Parses `A:B` or `A:B:STEP`; nullopt for anything else.
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
        fail(place, fmt::format("{}: the range {} is empty", key, printable(text, 80)));
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

bool has_control(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](char byte) {
        return static_cast<unsigned char>(byte) < ' ' && byte != '\t' && byte != '\n' && byte != '\r';
    });
}

/// @param known  the row of the key; null for keys and defines of the pattern
void check_value(const std::string& key, const GalleryKey* known, const std::string& value,
                 const std::string& place) {
    if (!fits_xml(value)) {
        fail(place, fmt::format("{}: '{}' contains {}", key, printable(value, 80),
                                has_control(value) ? "a control character" : "invalid UTF-8"));
    }
    if (!known) return;
    try {
        check_option({.name = known->name,
                      .help = "",
                      .unit = known->unit,
                      .kind = known->kind,
                      .least = known->least,
                      .most = known->most},
                     value);
    } catch (const SettingError& error) {
        fail(place, fmt::format("{}: {}, not '{}'", key, error.message(), printable(value, 80)));
    }
}

/// @param known  the row of the key; null for keys and defines of the pattern
void check_range(const std::string& key, const GalleryRange& range, const std::string& word, const GalleryKey* known,
                 const std::string& place) {
    if (!known) return;
    if (known->kind == OptionKind::flag) check_value(key, known, word, place);
    const bool is_countable = range.count <= most_gallery_jobs;
    if (known->kind == OptionKind::whole) {
        const auto is_whole_number = [](double value) {
            return value >= 0 && value == std::floor(value) && value < 1e11;
        };
        const double last = range.first + (range.count - 1) * range.step;
        if (!is_whole_number(range.first) || range.step != std::floor(range.step) ||
            (is_countable && !is_whole_number(last))) {
            fail(place, fmt::format("{}: expected whole numbers, 0 or more", key));
        }
    }
    check_value(key, known, range.value(0), place);
    if (is_countable) check_value(key, known, range.value(static_cast<std::uint64_t>(range.count) - 1), place);
}

void check_format(const GalleryKeys& keys, const std::string& format, const std::string& place) {
    const std::vector<std::string_view>& known = keys.formats();
    if (std::find(known.begin(), known.end(), format) != known.end()) return;
    for (const Interpreter* interpreter : keys.interpreters()) {
        if (const FormatName* row = find_format(interpreter->formats(), format)) {
            fail(place, fmt::format("{} files are not made in galleries; `sikku draw` makes them", row->label));
        }
    }
    const std::string_view near = nearest(format, known);
    fail(place, fmt::format("unknown format '{}'{}", printable(format, 80),
                            near.empty() ? fmt::format("; expected one of {}", fmt::join(known, ", "))
                                         : fmt::format("; did you mean '{}'?", near)));
}

/// Formats are separated by commas, on the command line as in a file.
std::vector<std::string> read_formats(const GalleryKeys& keys, const std::vector<std::string>& words,
                                      const std::string& place) {
    std::vector<std::string> formats;
    for (const std::string& word : words) {
        for (std::size_t at = 0; at <= word.size();) {
            const std::size_t comma = std::min(word.find(',', at), word.size());
            std::string format = lower_case(word.substr(at, comma - at));
            while (format.starts_with(' ') || format.starts_with('.')) format.erase(0, 1);
            while (format.ends_with(' ')) format.pop_back();
            check_format(keys, format, place);
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
        if (line.size() > longest_item_line) fail(place, "this line is longer than 16 MB");
    }
    return true;
}

}  // namespace

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

GalleryAxis axis_of(const std::string& key, const GalleryValue& value, const GalleryKey* known) {
    GalleryAxis axis(key, value.place, known == nullptr);
    // These may contain a colon.
    const bool is_prose = !known && (key == "title" || key == "source" || key == "description");
    for (const std::string& word : words_of(value, key)) {
        const auto range = is_prose ? std::nullopt : read_range(key, word, value.place);
        if (!range) {
            check_value(key, known, word, value.place);
            axis.add(word);
            continue;
        }
        check_range(key, *range, word, known, value.place);
        axis.add(*range);
    }
    return axis;
}

void read_gallery_key(const GalleryKeys& keys, const std::string& written, const GalleryValue& value,
                      GalleryItem& item) {
    const std::string key = folded_key(written);
    if (key == "pattern") {
        item.patterns = std::make_shared<const std::vector<std::string>>(words_of(value, key));
        item.patterns_place = value.place;
    } else if (key == "format") {
        item.formats = read_formats(keys, words_of(value, key), value.place);
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
    } else if (const GalleryKey* row = keys.find(key)) {
        item.take(std::make_shared<const GalleryAxis>(axis_of(key, value, row)));
    } else if (const std::string reason = keys.not_a_key(key); !reason.empty()) {
        fail(value.place, reason);
    } else {
        std::vector<std::string_view> known = {"pattern", "format", "name",    "set",  "generations",
                                               "item",    "poster", "contact", "title"};
        for (const GalleryKey& each : keys.list()) known.push_back(each.name);
        const std::string_view near = nearest(key, known);
        fail(value.place, fmt::format("unknown key '{}'{}", printable(written, 80),
                                      near.empty() ? "; keys and defines of patterns go into `set = { … }`"
                                                   : fmt::format("; did you mean '{}'?", near)));
    }
}

void check_sheet_size(const std::string& key, const std::string& size, const std::string& place) {
    try {
        read_draw_settings({{"size", size}, {"margin", "0mm"}});
    } catch (const SettingError& error) {
        fail(place, fmt::format("{} {}: {}", key, printable(size, 80), error.message()));
    }
}

void read_gallery(const GalleryKeys& keys, const std::string& file, const std::string& text, GalleryItem& defaults,
                  GalleryRequest& request, GalleryItems& items) {
    const GalleryValue root = read_toml(file, text);
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
            read_gallery_key(keys, key, value, defaults);
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
        for (const auto& [key, value] : element.table) read_gallery_key(keys, key, value, item);
        items.add(std::move(item));
    }
}

void read_manifest(const GalleryRequest& request, const GalleryKeys& keys, std::istream& stream,
                   const GalleryItem& defaults, GalleryItems& items) {
    const std::string& file = request.manifest;
    std::string line;
    std::string place = file + ":1";
    for (std::size_t number = 1; next_line(stream, line, place); place = fmt::format("{}:{}", file, ++number)) {
        if (number % 256 == 0) request.monitor.check();
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        GalleryItem item = defaults;
        item.place = place + ":1";
        item.needs_pattern = true;
        item.folder = std::filesystem::path(file).parent_path();
        const GalleryValue value = read_manifest_line(place, line);
        for (const auto& [key, element] : value.table) read_gallery_key(keys, key, element, item);
        items.add(std::move(item));
    }
}

}  // namespace sikku
