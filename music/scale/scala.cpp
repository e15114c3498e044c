// Reads Scala files: scales (.scl) and key maps (.kbm).
#include "music/scale/scale.h"

#include "engine/base/characters.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace sikku {
namespace {

/// Maximum size of a file. Offsets of spans need less than 4 GB.
constexpr std::size_t most_bytes = 16'000'000;
/// Twenty times the audible range; also excludes infinity.
constexpr double most_cents = 240'000.0;
/// Limit of the number of keys, and of the degrees, in the pattern of a .kbm file.
constexpr int most_degrees = 100'000;
constexpr double highest_frequency = 1e6;

/// Converts Latin-1 to UTF-8; keeps text that is UTF-8 already.
std::string to_utf8(std::string_view text) {
    bool is_utf8 = true;
    for (std::size_t i = 0; i < text.size() && is_utf8;) {
        const std::size_t length = utf8_length(text.substr(i));
        is_utf8 = length > 0;
        i += length;
    }
    if (is_utf8) return std::string(text);
    std::string result;
    for (const char byte : text) append_utf8(static_cast<unsigned char>(byte), result);
    return result;
}

/// A piece of the text.
struct Piece {
    std::size_t at = 0;
    std::string_view text;
};

/// The piece without blanks at either end.
Piece stripped(const Piece& piece) {
    const std::string_view text = trimmed(piece.text);
    return {piece.at + static_cast<std::size_t>(text.data() - piece.text.data()), text};
}

/// The lines of a file that are not comments.
class Lines {
public:
    explicit Lines(const Source& source) : source_(source), text_(source.text()) {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    }

    /// Reads the next line without its end, which is CR, LF or both; false at the end of the text.
    bool next(Piece& line) {
        while (at_ < text_.size()) {
            const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
            line = {at_, text_.substr(at_, end - at_)};
            at_ = text_.compare(end, 2, "\r\n") == 0 ? end + 2 : std::min(end + 1, text_.size());
            if (!line.text.starts_with('!')) return true;
        }
        return false;
    }
    /// Reads the next line that is not blank, without blanks at either end.
    bool next_filled(Piece& line) {
        while (next(line)) {
            line = stripped(line);
            if (!line.text.empty()) return true;
        }
        return false;
    }

    Span span(const Piece& piece) const { return {&source_, piece.at, piece.text.size()}; }
    /// The end of the text, for messages about missing lines.
    Span end() const { return {&source_, text_.size(), 0}; }

private:
    const Source& source_;
    std::string_view text_;
    std::size_t at_ = 0;
};

/// The text before the first blank or `!`; the rest is a remark.
Piece first_word(const Piece& line) {
    return {line.at, line.text.substr(0, line.text.find_first_of(" \t!"))};
}

/// The text of a piece in quotes, for a message.
std::string quoted(const Piece& piece) {
    return fmt::format("'{}'", printable(to_utf8(piece.text), 40));
}

/// Reports a file that is too long or contains a NUL byte, and returns false for it.
bool is_text(const Source& source, const char* kind, Diagnostics& diagnostics) {
    const std::string& text = source.text();
    if (text.size() > most_bytes) {
        diagnostics.unreadable({&source, 0, 0}, fmt::format("this is too long for {}", kind));
        return false;
    }
    const std::size_t zero = text.find('\0');
    if (zero != std::string::npos) {
        diagnostics.unreadable({&source, zero, 1}, fmt::format("this is not {}: it holds a NUL byte", kind));
        return false;
    }
    return true;
}

/// Reads a whole number with an optional sign; false for anything else.
bool read_whole(std::string_view text, std::int64_t& value) {
    if (text.size() > 1 && text[0] == '+' && is_digit(text[1])) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && !text.empty();
}

/// True for digits without sign, point or exponent.
bool is_digits(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// True for an optional sign, digits and a point: `-5.25`, `386.`, `.5`.
bool is_decimal(std::string_view text) {
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    const std::size_t point = text.find('.');
    if (point == std::string_view::npos || text.size() == 1) return false;
    const std::string_view before = text.substr(0, point);
    const std::string_view after = text.substr(point + 1);
    return (before.empty() || is_digits(before)) && (after.empty() || is_digits(after));
}

// --- .scl -------------------------------------------------------------------------------------------------------

class ScaleReader {
public:
    ScaleReader(const Source& source, Diagnostics& diagnostics)
        : source_(source), diagnostics_(diagnostics), lines_(source) {}

    std::optional<Scale> read() {
        Scale scale;
        Piece line;
        if (!lines_.next(line)) {
            error(lines_.end(),
                  "this is not a Scala scale: a description, the number of notes and the notes are missing");
            return std::nullopt;
        }
        scale.title = printable(to_utf8(trimmed(line.text)));
        std::int64_t count = 0;
        if (!read_count(count)) return std::nullopt;

        std::vector<double>& notes = scale.ascent;
        notes.push_back(0.0);
        std::int64_t found = 0;
        Piece last;
        // Every pitch is read, so that all errors are reported together.
        while (found < count && lines_.next_filled(line)) {
            ++found;
            last = first_word(line);
            double cents = 0;
            if (read_pitch(line, cents)) notes.push_back(cents);
        }
        if (found < count) {
            error(lines_.end(), fmt::format("{} of the {} notes are missing", count - found, count));
        } else {
            warn_of_more(count);
        }
        if (failed_) return std::nullopt;
        scale.period = notes.back();
        notes.pop_back();
        if (scale.period == 0.0) {
            error(lines_.span(last), "the last line is the period, at which the scale repeats; it cannot be 0 cents");
            return std::nullopt;
        }
        scale.descent = scale.ascent;
        scale.id = name();
        scale.group = "scala";
        scale.sources = printable(source_.name());
        return scale;
    }

private:
    void error(const Span& where, const std::string& message) {
        failed_ = true;
        diagnostics_.error(where, message);
    }

    /// Reports an error. @return false
    bool refuse(const Piece& piece, const std::string& message) {
        error(lines_.span(piece), message);
        return false;
    }

    bool read_count(std::int64_t& count) {
        Piece line;
        if (!lines_.next(line)) {
            error(lines_.end(), "after the description the number of notes is missing");
            return false;
        }
        line = stripped(line);
        const Piece word = first_word(line);
        if (word.text.empty()) return refuse(line, "the second line has to be the number of notes");
        if (!read_whole(word.text, count) || count < 0) {
            return refuse(word, fmt::format("the second line has to be the number of notes, not {}", quoted(word)));
        }
        return count > 0 || refuse(word, "a scale without notes cannot be played");
    }

    bool read_pitch(const Piece& line, double& cents) {
        const Piece word = first_word(line);
        const std::string_view text = word.text;
        if (text.empty()) {
            return refuse(line, "a comment has its ! at the very beginning of the line");
        }
        if (text.find('.') != std::string_view::npos) {
            double value = 0;
            if (!is_decimal(text)) {
                return refuse(word,
                              fmt::format("{} is neither cents, as 701.955, nor a ratio, as 3/2", quoted(word)));
            }
            const bool is_number = read_number(text, value);
            if (!is_number || std::fabs(value) > most_cents) {
                return refuse(
                    word, fmt::format("{} cents are beyond the {:.0f} that are allowed", quoted(word), most_cents));
            }
            cents = value;
            return true;
        }
        const std::size_t slash = text.find('/');
        const std::string_view above = text.substr(0, slash);
        const std::string_view below = slash == std::string_view::npos ? "1" : text.substr(slash + 1);
        const std::string_view rest = trimmed(line.text.substr(text.size()));
        if (slash == std::string_view::npos ? is_digits(text) && rest.starts_with('/')
                                            : below.empty() && !rest.empty() && is_digit(rest.front())) {
            return refuse(word, "a ratio is written without blanks: 3/2");
        }
        if ((text.starts_with('-') || text.starts_with('+')) && is_digits(above.substr(1)) && is_digits(below)) {
            return refuse(word,
                          text.starts_with('-')
                              ? fmt::format("{} is a ratio below 0; negative cents are written with a point: -5.0",
                                            quoted(word))
                              : fmt::format("{}: a ratio has no sign", quoted(word)));
        }
        if (!is_digits(above) || !is_digits(below)) {
            return refuse(word,
                          text.find(',') != std::string_view::npos
                              ? fmt::format("{}: cents are written with a point, as 701.955", quoted(word))
                              : fmt::format("{} is neither cents, as 701.955, nor a ratio, as 3/2", quoted(word)));
        }
        double numerator = 0;
        double denominator = 0;
        if (!read_number(above, numerator) || !read_number(below, denominator)) {
            return refuse(word, "the numbers of this ratio are too large");
        }
        if (numerator == 0 || denominator == 0) {
            return refuse(word, fmt::format("the ratio {} is not a pitch: expected numbers above 0", quoted(word)));
        }
        cents = 1200.0 * std::log2(numerator / denominator);
        if (std::fabs(cents) > most_cents) {
            return refuse(word, fmt::format("the ratio {} is beyond the {:.0f} cents that are allowed", quoted(word),
                                            most_cents));
        }
        if (slash == std::string_view::npos && numerator >= 100 && !warned_) {
            warned_ = true;
            diagnostics_.warning(lines_.span(word),
                                 fmt::format("without a point this is the ratio {0}/1, not {0} cents", text));
        }
        return true;
    }

    /// Warns of a line after the notes that looks like another note; other text may follow.
    void warn_of_more(std::int64_t count) {
        Piece line;
        while (lines_.next_filled(line)) {
            const Piece word = first_word(line);
            if (!is_decimal(word.text) && word.text.find_first_not_of("0123456789/") != std::string_view::npos)
                continue;
            diagnostics_.warning(lines_.span(word),
                                 fmt::format("there are more than {} notes; the rest is ignored", count));
            return;
        }
    }

    /// The file name without folder and extension.
    std::string name() const {
        std::string_view path = source_.name();
        if (const std::size_t slash = path.find_last_of('/'); slash != std::string_view::npos) {
            path.remove_prefix(slash + 1);
        }
        if (const std::size_t dot = path.find_last_of('.'); dot != std::string_view::npos && dot > 0) {
            path = path.substr(0, dot);
        }
        return printable(to_utf8(path));
    }

    const Source& source_;
    Diagnostics& diagnostics_;
    Lines lines_;
    bool failed_ = false;
    bool warned_ = false;
};

// --- .kbm -------------------------------------------------------------------------------------------------------

class KeyMapReader {
public:
    KeyMapReader(const Source& source, Diagnostics& diagnostics) : diagnostics_(diagnostics), lines_(source) {}

    std::optional<KeyMap> read() {
        KeyMap map;
        int size = 0;
        Piece place;
        if (!read_header("the size of the map", 0, most_degrees, size, place)) return std::nullopt;
        if (!read_header("the first key", 0, 127, map.first, place)) return std::nullopt;
        if (!read_header("the last key", 0, 127, map.last, place)) return std::nullopt;
        if (map.last < map.first && !failed_) error(lines_.span(place), "the last key lies below the first");
        if (!read_header("the middle key", 0, 127, map.middle, place)) return std::nullopt;
        Piece reference;
        if (!read_header("the key whose frequency is given", 0, 127, map.reference, reference)) return std::nullopt;
        if (!read_frequency(map.frequency)) return std::nullopt;
        if (!read_header("the degree of the formal octave", -most_degrees, most_degrees, map.octave_degree, place)) {
            return std::nullopt;
        }
        read_degrees(size, map);
        if (failed_) return std::nullopt;
        if (size > 0 && !map.degrees[pattern_place(map, map.reference)]) {
            error(lines_.span(reference),
                  fmt::format("the map leaves out key {}, whose frequency is given", map.reference));
            return std::nullopt;
        }
        return map;
    }

    static std::size_t pattern_place(const KeyMap& map, int key) {
        const auto size = static_cast<std::int64_t>(map.degrees.size());
        const std::int64_t away = std::int64_t{key} - map.middle;
        return static_cast<std::size_t>((away % size + size) % size);
    }

private:
    void error(const Span& where, const std::string& message) {
        failed_ = true;
        diagnostics_.error(where, message);
    }

    /// Reads a number, or reports an error in its line; false at the end of the file.
    bool read_header(const char* what, int least, int most, int& value, Piece& place) {
        Piece line;
        if (!lines_.next_filled(line)) {
            error(lines_.end(), fmt::format("this key map ends too early: {} is missing", what));
            return false;
        }
        place = first_word(line);
        std::int64_t number = 0;
        if (!read_whole(place.text, number)) {
            error(lines_.span(place), fmt::format("{} is a whole number, not {}", what, quoted(place)));
        } else if (number < least || number > most) {
            error(lines_.span(place), fmt::format("{} lies from {} to {}", what, least, most));
        } else {
            value = static_cast<int>(number);
        }
        return true;
    }

    bool read_frequency(double& frequency) {
        Piece line;
        if (!lines_.next_filled(line)) {
            error(lines_.end(), "this key map ends too early: the frequency is missing");
            return false;
        }
        const Piece word = first_word(line);
        double value = 0;
        if (!read_number(word.text, value)) {
            error(lines_.span(word), fmt::format("the frequency is a number of Hz, as 440.0, not {}", quoted(word)));
        } else if (!(value > 0) || value > highest_frequency || value < 1 / highest_frequency) {
            error(lines_.span(word), "the frequency lies above 0 and up to 1000000 Hz");
        } else {
            frequency = value;
        }
        return true;
    }

    void read_degrees(int size, KeyMap& map) {
        Piece line;
        int found = 0;
        while (found < size && lines_.next_filled(line)) {
            ++found;
            const Piece word = first_word(line);
            std::int64_t degree = 0;
            if (word.text == "x" || word.text == "X") {
                map.degrees.emplace_back(std::nullopt);
            } else if (!read_whole(word.text, degree)) {
                error(lines_.span(word), fmt::format("a degree is a whole number or x, not {}", quoted(word)));
            } else if (degree < -most_degrees || degree > most_degrees) {
                error(lines_.span(word), fmt::format("degrees lie from {} to {}", -most_degrees, most_degrees));
            } else {
                map.degrees.emplace_back(static_cast<int>(degree));
            }
        }
        // Lines of unmapped keys may be missing at the end of the file.
        if (!failed_) map.degrees.resize(static_cast<std::size_t>(size));
        while (lines_.next_filled(line)) {
            const Piece word = first_word(line);
            std::int64_t degree = 0;
            if (word.text != "x" && word.text != "X" && !read_whole(word.text, degree)) continue;
            diagnostics_.warning(lines_.span(word),
                                 size == 0
                                     ? std::string("the size of this map is 0; the rest of the file is ignored")
                                     : fmt::format("there are more than {} degrees; the rest is ignored", size));
            return;
        }
    }

    Diagnostics& diagnostics_;
    Lines lines_;
    bool failed_ = false;
};

/// Cents of a key above degree 0; nullopt if the map leaves it out.
std::optional<double> cents_of_key(const Scale& scale, const KeyMap& map, int key) {
    const std::int64_t away = std::int64_t{key} - map.middle;
    if (map.degrees.empty()) return scale.cents(away, false);
    const std::size_t place = KeyMapReader::pattern_place(map, key);
    const std::optional<int>& degree = map.degrees[place];
    if (!degree) return std::nullopt;
    const std::int64_t turn =
        (away - static_cast<std::int64_t>(place)) / static_cast<std::int64_t>(map.degrees.size());
    const double octave = map.octave_degree == 0 ? scale.period : scale.cents(map.octave_degree, false);
    return scale.cents(*degree, false) + static_cast<double>(turn) * octave;
}

}  // namespace

std::optional<Scale> read_scl(const Source& source, Diagnostics& diagnostics) {
    if (!is_text(source, "a Scala scale", diagnostics)) return std::nullopt;
    return ScaleReader(source, diagnostics).read();
}

std::optional<KeyMap> read_kbm(const Source& source, Diagnostics& diagnostics) {
    if (!is_text(source, "a Scala key map", diagnostics)) return std::nullopt;
    return KeyMapReader(source, diagnostics).read();
}

std::optional<double> mapped_key(const Scale& scale, const KeyMap& map, int key) {
    if (key < map.first || key > map.last) return std::nullopt;
    const auto cents = cents_of_key(scale, map, key);
    const auto reference = cents_of_key(scale, map, map.reference);
    if (!cents || !reference) return std::nullopt;
    return 69.0 + 12.0 * std::log2(map.frequency / 440.0) + (*cents - *reference) / 100.0;
}

}  // namespace sikku
