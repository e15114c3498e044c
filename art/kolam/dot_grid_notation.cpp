// art/kolam/dot_grid_notation.cpp: reads the notations of grids of dots.
#include "art/kolam/dot_grid.h"
#include "art/kolam/dot_grid_text.h"
#include "art/kolam/dot_rectangle.h"
#include "engine/base/characters.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

[[noreturn]] void refuse(std::string_view text) {
    throw std::runtime_error(fmt::format(
        "'{}': expected ROWSxCOLUMNS such as 7x7, the dots of each row such as 1-3-5-3-1, the longest "
        "row and the last such as '7 to 1' or '15-8 idukku', letters such as text:MEERA, or a shape of 'o' and "
        "'.'; every number 1 or more",
        printable(text, 80)));
}

[[noreturn]] void refuse(std::string_view text, std::string_view reason) {
    throw std::runtime_error(fmt::format("'{}': {}", printable(text, 80), reason));
}

[[noreturn]] void refuse_fill(std::string_view text) {
    refuse(text, "expected fill, ROWSxfill or fillxCOLUMNS, and 'idukku' for interlaced dots");
}

std::string replaced(std::string_view text, std::string_view from, char to) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const bool is_found = text.substr(at).starts_with(from);
        result += is_found ? to : text[at];
        at += is_found ? from.size() : 1;
    }
    return result;
}

// --- shapes -------------------------------------------------------------------------------------------------------

bool is_drawn_dot(char byte) {
    return std::string_view("oO*#").find(byte) != std::string_view::npos;
}
bool is_hole(char byte) {
    return byte == '.' || byte == '_';
}

bool is_row_end(char byte) {
    return byte == '/' || byte == '\n';
}
bool is_of_shape(char byte) {
    return is_drawn_dot(byte) || is_hole(byte) || is_row_end(byte) || byte == ' ' || byte == '\r';
}

/// True for texts with more places than other characters, or as many in several rows: words and numbers have fewer.
bool is_shape(std::string_view text) {
    const auto places =
        std::count_if(text.begin(), text.end(), [](char byte) { return is_drawn_dot(byte) || is_hole(byte); });
    const auto others = std::count_if(text.begin(), text.end(),
                                      [](char byte) { return !is_of_shape(byte) && !is_continuation(byte); });
    return places > others || (places > 0 && places == others && std::any_of(text.begin(), text.end(), is_row_end));
}

/// Refuses characters that are not places.
void check_shape(std::string_view text) {
    std::size_t row = 1;
    std::size_t column = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (is_row_end(text[at])) {
            ++row;
            column = 0;
        } else if (!is_continuation(text[at])) {
            ++column;
        }
        if (is_of_shape(text[at])) continue;
        std::size_t end = at + 1;
        while (end < text.size() && is_continuation(text[end])) ++end;
        refuse(text, fmt::format("line {}, column {}: '{}' is not a place; expected o, O, * or # for a dot, . or _ "
                                 "for none, or a blank",
                                 row, column, printable(text.substr(at, end - at), 8)));
    }
    if (std::none_of(text.begin(), text.end(), is_drawn_dot)) refuse(text, "the shape has no dots");
}

DotGrid parse_shape(std::string_view text) {
    check_shape(text);
    std::vector<std::string_view> lines;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find_first_of("/\n", at), text.size());
        std::string_view line = text.substr(at, end - at);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
        at = end + 1;
    }
    // Places that stand side by side fill a square lattice; otherwise every second column does.
    const bool is_dense = std::any_of(lines.begin(), lines.end(), [](std::string_view line) {
        const auto is_place = [](char byte) { return byte != ' '; };
        return std::adjacent_find(line.begin(), line.end(),
                                  [&](char a, char b) { return is_place(a) && is_place(b); }) != line.end();
    });
    std::vector<std::vector<std::int32_t>> columns(lines.size());
    std::optional<std::uint32_t> parity[2];  // parity of the columns of places in even and odd rows
    std::uint64_t count = 0;
    for (std::size_t r = 0; r < lines.size(); ++r) {
        for (std::size_t i = 0; i < lines[r].size(); ++i) {
            if (lines[r][i] == ' ') continue;
            if (!is_dense) {
                const auto found = static_cast<std::uint32_t>(i % 2);
                if (parity[r % 2].value_or(found) != found) {
                    refuse(text, fmt::format("column {} of row {} lies between the points of the lattice: in "
                                             "a row with blanks, all dots stand in odd columns or all in even ones, "
                                             "and rows either agree or alternate",
                                             i + 1, r + 1));
                }
                parity[r % 2] = found;
            }
            if (!is_drawn_dot(lines[r][i])) continue;
            if (++count > DotGrid::most_dots) break;
            columns[r].push_back(static_cast<std::int32_t>(is_dense ? 2 * i : i));
        }
    }
    const bool is_triangular = parity[0] && parity[1] && *parity[0] != *parity[1];
    return DotGrid(is_triangular ? DotLattice::triangular : DotLattice::square, columns);
}

// --- text ---------------------------------------------------------------------------------------------------------

struct TextInDots {
    std::string_view letters;
    std::uint32_t rows = usual_letter_rows;
};

/// Reads `text:MEERA` and `text 12:MEERA`; nullopt for other notations.
std::optional<TextInDots> parse_text_in_dots(std::string_view given) {
    constexpr std::string_view word = "text";
    while (given.starts_with(' ') || given.starts_with('\t')) given.remove_prefix(1);
    const std::size_t colon = given.find(':');
    if (colon == std::string_view::npos || !lower_case(given.substr(0, word.size())).starts_with(word)) return {};
    TextInDots text{given.substr(colon + 1)};
    const std::string_view rows = trimmed(given.substr(word.size(), colon - word.size()));
    if (rows.empty()) return text;
    const auto [end, error] = std::from_chars(rows.data(), rows.data() + rows.size(), text.rows);
    if (error != std::errc() || end != rows.data() + rows.size() || text.rows < fewest_letter_rows ||
        text.rows > most_letter_rows) {
        refuse(given, fmt::format("'{}' is not a number of rows of dots from {} to {}; expected text:LETTERS or "
                                  "'text ROWS:LETTERS'",
                                  printable(rows, 40), fewest_letter_rows, most_letter_rows));
    }
    return text;
}

// --- numbers ------------------------------------------------------------------------------------------------------

enum class Sort : std::uint8_t { unknown, straight, interlaced };

constexpr std::string_view fill_word = "fill";
constexpr std::string_view until_word = "until";  // follows the last row, as in `7 dots 1 until`

/// Tamil words for grids and the words that they stand for; numbers as the names of grids spell them.
constexpr std::pair<std::string_view, std::string_view> tamil_words[] = {
    {"நேர்", "ner"},
    {"நேர்ப்புள்ளி", "ner"},
    {"நேர்புள்ளி", "ner"},
    {"இடுக்கு", "idukku"},
    {"இடுக்குப்", "idukku"},
    {"இடுக்குப்புள்ளி", "idukku"},
    {"இடுக்குபுள்ளி", "idukku"},
    {"சந்து", "sandhu"},
    {"சந்துப்", "sandhu"},
    {"சந்துப்புள்ளி", "sandhu"},
    {"சந்துபுள்ளி", "sandhu"},
    {"ஊடு", "oodu"},
    {"ஊடுப்", "oodu"},
    {"ஊடுபுள்ளி", "oodu"},
    {"ஊடுப்புள்ளி", "oodu"},
    {"புள்ளி", "dots"},
    {"புள்ளிகள்", "dots"},
    {"புள்ளியில்", "dots"},
    {"கோலம்", "kolam"},
    {"வரிசை", "rows"},
    {"வரிசைகள்", "rows"},
    {"முதல்", "to"},
    {"வரை", until_word},
    {"ஒன்று", "1"},
    {"ஒரு", "1"},
    {"இரண்டு", "2"},
    {"மூன்று", "3"},
    {"நான்கு", "4"},
    {"ஐந்து", "5"},
    {"ஆறு", "6"},
    {"ஏழு", "7"},
    {"எட்டு", "8"},
    {"ஒன்பது", "9"},
    {"பத்து", "10"},
    {"பதினொன்று", "11"},
    {"பன்னிரண்டு", "12"},
    {"பதிமூன்று", "13"},
    {"பதின்மூன்று", "13"},
    {"பதினான்கு", "14"},
    {"பதினைந்து", "15"},
    {"பதினாறு", "16"},
    {"பதினேழு", "17"},
    {"பதினெட்டு", "18"},
    {"பத்தொன்பது", "19"},
    {"இருபது", "20"},
    {"இருபத்தொன்று", "21"},
    {"இருபத்தைந்து", "25"},
};

bool is_beyond_ascii(char byte) {
    return static_cast<unsigned char>(byte) >= 0x80;
}

/// Replaces Tamil words and digits; unknown words are kept.
std::string without_tamil(std::string_view text) {
    constexpr std::string_view zero = "௦";  // the digits follow one another, and differ in their last byte
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        if (!is_beyond_ascii(text[at])) {
            result += text[at++];
            continue;
        }
        const std::string_view rest = text.substr(at);
        const auto digit = [&](std::string_view bytes) {
            return bytes.size() >= zero.size() && bytes.starts_with(zero.substr(0, 2)) && bytes[2] >= zero[2] &&
                   bytes[2] < zero[2] + 10;
        };
        if (digit(rest)) {
            result += static_cast<char>('0' + (rest[2] - zero[2]));
            at += zero.size();
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && is_beyond_ascii(text[end]) && !digit(text.substr(end))) ++end;
        const std::string_view word = text.substr(at, end - at);
        const auto known = std::find_if(std::begin(tamil_words), std::end(tamil_words),
                                        [word](const auto& pair) { return pair.first == word; });
        result += known != std::end(tamil_words) ? fmt::format(" {} ", known->second) : std::string(word);
        at = end;
    }
    return result;
}

/// A number of dots, and a number of rows after an `x`, 0 without one.
struct Item {
    std::uint32_t dots = 0;
    std::uint32_t rows = 0;
    char separator = 0;  ///< before the item: '-', ',', 't' for `to`, 0 for the first
};

/// Splits `7 to 1 ner pulli` into items and a sort.
class NotationReader {
public:
    explicit NotationReader(std::string_view given) : given_(given), text_(lower_case(given)) {
        for (const char* dash : {"–", "—", "−"}) text_ = replaced(text_, dash, '-');
        text_ = without_tamil(replaced(text_, "×", 'x'));
    }
    /// Accepts the word `fill` as a number of dots or rows, 0.
    NotationReader& with_fill() {
        has_fill_ = true;
        return *this;
    }

    std::pair<std::vector<Item>, Sort> read() {
        for (skip(); at_ < text_.size(); skip()) read_part();
        if (items_.empty() || separator_ != 0 || is_times_) refuse(given_);
        return {items_, sort_};
    }

private:
    void skip() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    }
    void read_part() {
        const char byte = text_[at_];
        if (byte >= '0' && byte <= '9') return read_number();
        if (byte == '-' || byte == ',') {
            ++at_;
            return separate(byte);
        }
        const std::size_t begin = at_;
        const auto is_letter = [](char letter) {
            return (letter >= 'a' && letter <= 'z') || is_beyond_ascii(letter);
        };
        while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
        if (begin == at_) refuse(given_);
        read_word(std::string_view(text_).substr(begin, at_ - begin));
    }
    void read_word(std::string_view word) {
        const auto is_one_of = [&](std::initializer_list<std::string_view> words) {
            return std::find(words.begin(), words.end(), word) != words.end();
        };
        if (is_one_of({"x", "by"})) {
            if (items_.empty() || separator_ != 0 || is_times_ || items_.back().rows != 0) refuse(given_);
            is_times_ = true;
        } else if (word == fill_word && has_fill_) {
            put_number(0);
        } else if (word == "to") {
            separate('t');
        } else if (word == until_word) {
            if (items_.empty() || separator_ != 0 || is_times_ || items_.back().separator != 't') refuse(given_);
        } else if (is_one_of({"ner", "neer", "straight", "square", "parallel"})) {
            set_sort(Sort::straight);
        } else if (is_one_of({"idukku", "sandhu", "sandu", "udu", "oodu", "idai", "interlaced", "interlocked",
                              "staggered", "triangular", "hexagonal"})) {
            set_sort(Sort::interlaced);
        } else if (!is_one_of(
                       {"pulli", "pullis", "pulligal", "dot", "dots", "grid", "kolam", "rows", "row", "lines"})) {
            refuse(given_, fmt::format("unknown word '{}'; the words for grids are ner (straight) and idukku "
                                       "(interlaced), நேர் and இடுக்கு in Tamil",
                                       printable(word, 40)));
        }
    }
    void set_sort(Sort sort) {
        if (sort_ != Sort::unknown && sort_ != sort) refuse(given_, "a grid is either straight or interlaced");
        sort_ = sort;
    }
    void separate(char separator) {
        if (items_.empty() || separator_ != 0 || is_times_) refuse(given_);
        separator_ = separator;
    }
    void read_number() {
        std::uint32_t number = 0;
        const char* begin = text_.data() + at_;
        const auto [rest, error] = std::from_chars(begin, text_.data() + text_.size(), number);
        if (error == std::errc::result_out_of_range) number = std::numeric_limits<std::uint32_t>::max();
        at_ += static_cast<std::size_t>(rest - begin);
        if (number == 0) refuse(given_);
        put_number(number);
    }
    void put_number(std::uint32_t number) {
        if (is_times_) {
            items_.back().rows = number;
            is_times_ = false;
        } else {
            if (!items_.empty() && separator_ == 0 && is_before_until()) separator_ = 't';
            if (!items_.empty() && separator_ == 0) refuse(given_);
            items_.push_back({number, 0, separator_});
            separator_ = 0;
        }
    }

    /// True if the next word is `until`.
    bool is_before_until() {
        skip();
        return std::string_view(text_).substr(at_).starts_with(until_word);
    }

    std::string_view given_;
    std::string text_;
    std::size_t at_ = 0;
    std::vector<Item> items_;
    Sort sort_ = Sort::unknown;
    char separator_ = 0;
    bool is_times_ = false;
    bool has_fill_ = false;
};

class Notation {
public:
    Notation(std::string_view text, std::vector<Item> items, Sort sort)
        : text_(text), items_(std::move(items)), sort_(sort) {}

    DotGrid grid() {
        const bool all_blocks = std::all_of(items_.begin(), items_.end(), [](const Item& i) { return i.rows > 0; });
        const bool no_blocks = std::all_of(items_.begin(), items_.end(), [](const Item& i) { return i.rows == 0; });
        if (items_.size() == 1) return all_blocks ? rectangle() : made({items_[0].dots});
        if (items_.size() == 2 && items_[1].separator == 't' && items_[1].rows == 0) {
            return spindle(items_[0].dots, std::max(items_[0].rows, 1U), items_[1].dots);
        }
        if (all_blocks && all_separated_by('-')) return blocks();
        if (!no_blocks) refuse(text_);
        return numbers();
    }

private:
    bool all_separated_by(char separator) const {
        return std::all_of(items_.begin() + 1, items_.end(),
                           [separator](const Item& item) { return item.separator == separator; });
    }
    /// Limits a product before it is computed; the grid itself counts its dots.
    void check_size(std::uint64_t dots, std::uint64_t rows) const {
        if (dots > DotGrid::most_dots || rows > DotGrid::most_dots || dots * rows > 2 * DotGrid::most_dots) {
            made({static_cast<std::uint32_t>(DotGrid::most_dots), 1});
        }
    }
    DotGrid made(std::vector<std::uint32_t> rows) const {
        DotGrid grid(std::move(rows));
        if (sort_ != Sort::unknown && grid.rows().size() > 1 &&
            (sort_ == Sort::interlaced) != (grid.lattice() == DotLattice::triangular)) {
            refuse(text_, sort_ == Sort::interlaced
                              ? "the rows of an interlaced grid alternate between odd and even numbers of dots"
                              : "the rows of a straight grid have all odd or all even numbers of dots");
        }
        return grid;
    }
    DotGrid rectangle() const {
        const std::uint32_t first = items_[0].dots;
        const std::uint32_t second = items_[0].rows;
        if (sort_ == Sort::interlaced && first > second) return spindle(first, 1, second);
        check_size(first, second);
        if (sort_ != Sort::interlaced) return DotGrid(std::vector<std::uint32_t>(first, second));
        std::vector<std::uint32_t> rows;
        for (std::uint32_t r = 0; r < first; ++r) rows.push_back(second - r % 2);
        return made(std::move(rows));
    }
    /// `count` rows of the longest, then shorter ones above and below to the last.
    DotGrid spindle(std::uint32_t longest, std::uint32_t count, std::uint32_t last) const {
        if (last > longest) std::swap(longest, last);
        const std::uint32_t difference = longest - last;
        // Without a word, the hexagons 3-2, 5-3, 7-4, … and grids that cannot be straight are interlaced.
        const bool is_interlaced =
            sort_ == Sort::interlaced || (sort_ == Sort::unknown && (difference % 2 != 0 || longest + 1 == 2 * last));
        if (!is_interlaced && difference % 2 != 0) {
            refuse(
                text_,
                fmt::format(
                    "each straight row is two dots shorter than the one before, so that rows from {} never reach {}",
                    longest, last));
        }
        if (is_interlaced && count > 1) {
            refuse(text_, "interlaced rows of the same length cannot be neighbours");
        }
        const std::uint32_t less = is_interlaced ? 1 : 2;
        check_size(longest, std::uint64_t{2} * (difference / less) + count);
        std::vector<std::uint32_t> rows;
        for (std::uint32_t row = last; row < longest; row += less) rows.push_back(row);
        const std::size_t above = rows.size();
        rows.insert(rows.end(), count, longest);
        for (std::size_t i = above; i-- > 0;) rows.push_back(rows[i]);
        return DotGrid(std::move(rows));
    }
    /// The block in the middle, then those above and below it.
    DotGrid blocks() const {
        std::vector<std::uint32_t> rows;
        std::uint64_t count = 0;
        for (const Item& item : items_) check_size(item.dots, count += 2 * std::uint64_t{item.rows});
        for (std::size_t i = items_.size(); i-- > 0;) rows.insert(rows.end(), items_[i].rows, items_[i].dots);
        for (std::size_t i = 1; i < items_.size(); ++i) rows.insert(rows.end(), items_[i].rows, items_[i].dots);
        return made(std::move(rows));
    }
    DotGrid numbers() const {
        const auto dots = [this](std::size_t i) { return items_[i].dots; };
        const bool is_to = all_separated_by('t');
        if (!is_to && std::any_of(items_.begin(), items_.end(), [](const Item& i) { return i.separator == 't'; })) {
            refuse(text_);
        }
        if (items_.size() == 2 &&
            (is_to || (items_[1].separator == '-' && (dots(0) >= dots(1) || sort_ != Sort::unknown)))) {
            return spindle(dots(0), 1, dots(1));
        }
        const bool is_there_and_back = items_.size() == 3 && dots(0) == dots(2) && dots(0) < dots(1);
        if (is_there_and_back && (is_to || (sort_ != Sort::unknown && all_separated_by('-')))) {
            return spindle(dots(1), 1, dots(0));
        }
        if (is_to) refuse(text_);
        std::vector<std::uint32_t> rows;
        for (const Item& item : items_) rows.push_back(item.dots);
        return made(std::move(rows));
    }

    std::string_view text_;
    std::vector<Item> items_;
    Sort sort_;
};

}  // namespace

DotGrid parse_dot_grid(std::string_view given) {
    if (const auto text = parse_text_in_dots(given)) return text_grid(text->letters, text->rows);
    const std::string text = replaced(replaced(given, "•", 'o'), "●", 'o');
    if (is_shape(text)) return parse_shape(text);
    if (parse_fill(given)) refuse(given, "this grid needs a page to fill; expected numbers of dots, such as 7x9");
    auto [items, sort] = NotationReader(given).read();
    return Notation(given, std::move(items), sort).grid();
}

std::optional<DotRectangle> parse_fill(std::string_view text) {
    const std::string_view given = trimmed(text);
    const std::size_t at = lower_case(given).find(fill_word);
    if (at == std::string_view::npos || parse_text_in_dots(given)) return std::nullopt;
    // `7xfill` is one word otherwise.
    const std::string spaced =
        fmt::format("{} {} {}", given.substr(0, at), fill_word, given.substr(at + fill_word.size()));
    const auto [items, sort] = [&] {
        try {
            return NotationReader(spaced).with_fill().read();
        } catch (const std::runtime_error&) {
            refuse_fill(given);
        }
    }();
    const Item& sides = items.front();
    if (items.size() != 1 || (sides.dots != 0 && sides.rows != 0)) refuse_fill(given);
    return DotRectangle{sort == Sort::interlaced ? DotLattice::triangular : DotLattice::square, sides.dots,
                        sides.rows};
}

std::string dot_grid_title(std::string_view given) {
    const auto text = parse_text_in_dots(given);
    return text ? std::string(trimmed(replaced(replaced(text->letters, "/", ' '), "\n", ' '))) : "";
}

std::string dot_grid_note(std::string_view given) {
    if (parse_text_in_dots(given)) return "";
    const std::string text = replaced(replaced(given, "•", 'o'), "●", 'o');
    if (is_shape(text)) return "";
    const auto [items, sort] = NotationReader(given).read();
    const auto is_number = [](const Item& item) { return item.rows == 0 && item.separator != 't'; };
    if (!std::all_of(items.begin(), items.end(), is_number)) return "";
    const DotGrid grid = parse_dot_grid(given);
    const std::vector<std::uint32_t> rows = grid.rows();
    if (rows.size() == 1 && rows[0] > 2) {
        const std::uint32_t least = rows[0] % 2 == 0 ? 2 : 1;
        return fmt::format("one row of {} dots; for rows from {} up to {} and back write {}-{}", rows[0], least,
                           rows[0], rows[0], least);
    }
    // A jump of more than two dots.
    if (rows.size() != 3 || rows[0] != rows[2] || rows[1] <= rows[0] + 2) return "";
    return fmt::format("three rows of {}, {} and {} dots; for {} up to {} and back write {}-{}", rows[0], rows[1],
                       rows[2], rows[0], rows[1], rows[1], rows[0]);
}

}  // namespace sikku
