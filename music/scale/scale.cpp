#include "music/scale/scale.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <embedded/scales.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace sikku {
namespace {

/// Notes closer than this number of cents are equal.
constexpr double same_note = 0.01;

std::int64_t floor_divide(std::int64_t value, std::int64_t by) {
    return value / by - (value % by < 0 ? 1 : 0);
}

// --- names ------------------------------------------------------------------------------------------------------

/// The plain letter of an accented code point, 0 for characters that keys omit, -1 for all others.
int plain_letter(char32_t point) {
    constexpr std::string_view latin_1 = "aaaaaaaceeeeiiiidnooooo*ouuuuytsaaaaaaaceeeeiiiidnooooo*ouuuuyty";
    constexpr std::string_view latin_a =
        "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkkllllllllllnnnnnnnnnoooooooorrrrrrssssssssttttttuuuu"
        "uu"
        "uuuuuuwwyyyzzzzzzs";
    static_assert(latin_1.size() == 0x40 && latin_a.size() == 0x80);
    struct Block {
        char32_t last;
        char letter;
    };
    // From U+1E00 on: letters with dots below and the like, used in Indian names.
    static constexpr std::array<Block, 36> more = {
        {{0x1E01, 'a'}, {0x1E07, 'b'}, {0x1E09, 'c'}, {0x1E13, 'd'}, {0x1E1D, 'e'}, {0x1E1F, 'f'},
         {0x1E21, 'g'}, {0x1E2B, 'h'}, {0x1E2F, 'i'}, {0x1E35, 'k'}, {0x1E3D, 'l'}, {0x1E43, 'm'},
         {0x1E4B, 'n'}, {0x1E53, 'o'}, {0x1E57, 'p'}, {0x1E5F, 'r'}, {0x1E69, 's'}, {0x1E71, 't'},
         {0x1E7B, 'u'}, {0x1E7F, 'v'}, {0x1E89, 'w'}, {0x1E8D, 'x'}, {0x1E8F, 'y'}, {0x1E95, 'z'},
         {0x1E96, 'h'}, {0x1E97, 't'}, {0x1E98, 'w'}, {0x1E99, 'y'}, {0x1E9A, 'a'}, {0x1E9F, 's'},
         {0x1EB7, 'a'}, {0x1EC7, 'e'}, {0x1ECB, 'i'}, {0x1EE3, 'o'}, {0x1EF1, 'u'}, {0x1EF9, 'y'}}};
    if (point == 0xA0 || (point >= 0x2B9 && point <= 0x2C1) || (point >= 0x300 && point <= 0x36F)) return 0;
    if (point >= 0x2010 && point <= 0x2019) return 0;  // dashes and quotes
    if (point == 0x266F) return 0;                     // the sharp sign is omitted like #
    if (point == 0x266D) return 'b';
    if (point >= 0xC0 && point <= 0xFF) return latin_1[point - 0xC0];
    if (point >= 0x100 && point <= 0x17F) return latin_a[point - 0x100];
    if (point < 0x1E00) return -1;
    for (const Block& block : more) {
        if (point <= block.last) return block.letter;
    }
    return -1;
}

/// The key by which names are compared: lower-case letters and digits without accents, blanks, `-`, `_`, `'`, `#`.
std::string folded(std::string_view name) {
    std::string key;
    for (std::size_t i = 0; i < name.size();) {
        const char byte = name[i];
        const std::size_t length = utf8_length(name.substr(i));
        if (length <= 1) {
            if (byte >= 'A' && byte <= 'Z') {
                key += static_cast<char>(byte - 'A' + 'a');
            } else if (std::string_view(" \t\r\n-_'#").find(byte) == std::string_view::npos) {
                key += byte;
            }
            ++i;
            continue;
        }
        char32_t point = static_cast<unsigned char>(byte) & (0x7FU >> length);
        for (std::size_t j = 1; j < length; ++j) {
            point = point << 6 | (static_cast<unsigned char>(name[i + j]) & 0x3FU);
        }
        const int letter = plain_letter(point);
        if (letter > 0) key += static_cast<char>(letter);
        if (letter < 0) key += name.substr(i, length);
        i += length;
    }
    return key;
}

/// Reduces transliterations of one Indian name to the same text: Kiravani, Keeravani; Gowrimanohari, Gaurimanohari;
/// Charukeshi, Charukesi.
std::string loosely_folded(std::string_view key) {
    std::string text(key);
    const auto replace = [&](std::string_view from, std::string_view to) {
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
            text.replace(at, from.size(), to);
        }
    };
    replace("ee", "i");
    replace("oo", "u");
    replace("ou", "au");
    replace("ow", "au");
    replace("w", "v");
    std::string result;
    for (const char letter : text) {
        const char before = result.empty() ? '\0' : result.back();
        if (letter == before && (letter < '0' || letter > '9')) continue;
        if (letter == 'h' && std::string_view("bcdgjkpst").find(before) != std::string_view::npos && before != '\0') {
            continue;
        }
        result += letter;
    }
    if (result.size() > 3 && result.ends_with("am")) result.pop_back();
    return result;
}

// --- the data file ----------------------------------------------------------------------------------------------

/// Removes the text before `mark`, and the mark, from `text` and returns it trimmed; all of it without a mark.
std::string_view take_until(std::string_view& text, std::string_view mark) {
    const std::size_t at = std::min(text.find(mark), text.size());
    const std::string_view piece = trimmed(text.substr(0, at));
    text.remove_prefix(std::min(at + mark.size(), text.size()));
    return piece;
}

class DataError : public std::logic_error {
    using std::logic_error::logic_error;
};

double number(std::string_view text) {
    double value = 0;
    if (!read_number(text, value)) throw DataError(fmt::format("'{}' is not a number", text));
    return value;
}

/// Cents of a ratio `3/2` or of cents `701.955`.
double interval(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return number(text);
    return 1200.0 * std::log2(number(text.substr(0, slash)) / number(text.substr(slash + 1)));
}

std::vector<double> read_notes(std::string_view text, double period, int division) {
    std::vector<double> notes;
    while (!text.empty()) {
        const std::string_view word = take_until(text, " ");
        if (word.empty()) continue;
        const bool is_step = word.find_first_not_of("0123456789") == std::string_view::npos;
        const double cents = is_step ? period * number(word) / division : interval(word);
        if (notes.empty() ? cents != 0 : !(cents > notes.back())) throw DataError("notes begin with 0 and rise");
        notes.push_back(cents);
    }
    if (notes.empty() || !(notes.back() < period)) throw DataError("notes lie within the period");
    return notes;
}

/// Reads `19: 0 3 6 8 11 14 17 down 0 3 5 8 11 13 16 = 2/1`.
void read_pitches(std::string_view text, int division, Scale& scale) {
    const std::size_t equals = text.find('=');
    if (equals != std::string_view::npos) {
        scale.period = interval(trimmed(text.substr(equals + 1)));
        text = trimmed(text.substr(0, equals));
    }
    if (text.find(':') != std::string_view::npos) division = static_cast<int>(number(take_until(text, ":")));
    const std::string_view up = take_until(text, " down ");
    scale.ascent = read_notes(up, scale.period, division);
    scale.descent = text.empty() ? scale.ascent : read_notes(text, scale.period, division);
}

constexpr std::array<std::string_view, 2> prefixes = {"raga-", "maqam-"};

/// Makes the title of a scale from its id.
std::string title_of(std::string_view id) {
    for (const std::string_view prefix : prefixes) {
        if (id.starts_with(prefix)) id.remove_prefix(prefix.size());
    }
    std::string title(id);
    std::replace(title.begin(), title.end(), '-', ' ');
    if (title[0] >= 'a' && title[0] <= 'z') title[0] = static_cast<char>(title[0] - 'a' + 'A');
    return title;
}

// --- the 72 melakarta -------------------------------------------------------------------------------------------

/// Names of the 72 melakarta in order, separated by blanks.
constexpr std::string_view mela_names =
    "Kanakangi Ratnangi Ganamurti Vanaspati Manavati Tanarupi Senavati Hanumatodi Dhenuka Natakapriya "
    "Kokilapriya Rupavati Gayakapriya Vakulabharanam Mayamalavagowla Chakravakam Suryakantam Hatakambari "
    "Jhankaradhwani Natabhairavi Keeravani Kharaharapriya Gourimanohari Varunapriya Mararanjani Charukesi "
    "Sarasangi Harikambhoji Dheerasankarabharanam Naganandini Yagapriya Ragavardhini Gangeyabhushani "
    "Vagadheeswari Sulini Chalanata Salagam Jalarnavam Jhalavarali Navaneetam Pavani Raghupriya Gavambodhi "
    "Bhavapriya Subhapantuvarali Shadvidhamargini Suvarnangi Divyamani Dhavalambari Namanarayani "
    "Kamavardhini Ramapriya Gamanashrama Vishwambari Shamalangi Shanmukhapriya Simhendramadhyamam Hemavati "
    "Dharmavati Neetimati Kantamani Rishabhapriya Latangi Vachaspati Mechakalyani Chitrambari Sucharitra "
    "Jyotiswarupini Dhatuvardhani Nasikabhushani Kosalam Rasikapriya";

/// Other names of melakarta, apart from variant spellings.
constexpr std::array<std::pair<int, std::string_view>, 7> more_mela_names = {{{8, "carnatic-todi"},
                                                                              {29, "shankarabharanam"},
                                                                              {36, "chalanattai"},
                                                                              {51, "pantuvarali"},
                                                                              {53, "gamanasrama"},
                                                                              {56, "shanmugapriya"},
                                                                              {65, "kalyani"}}};

/// Melakarta `n`, 1 to 72, by the formula of Venkatamakhin: the six chakras of a half take all pairs of second and
/// third, the six ragas of a chakra those of sixth and seventh; the fourth is pure in the first half and raised in
/// the second.
Scale melakarta(int n, std::string_view name) {
    static constexpr std::array<std::array<int, 2>, 6> pairs = {{{1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}};
    static constexpr std::array<std::string_view, 12> chakras = {
        "Indu", "Netra", "Agni", "Veda", "Bana", "Rutu", "Rishi", "Vasu", "Brahma", "Disi", "Rudra", "Aditya"};
    const auto chakra = static_cast<std::size_t>((n - 1) / 6);
    const auto [r, g] = pairs[chakra % 6];
    const auto [d, v] = pairs[static_cast<std::size_t>((n - 1) % 6)];
    const int m = n <= 36 ? 5 : 6;
    Scale scale;
    scale.id = fmt::format("mela-{}", n);
    scale.title = name;
    scale.group = "melakarta";
    for (const int step : {0, r, g, m, 7, 7 + d, 7 + v}) scale.ascent.push_back(100.0 * step);
    scale.descent = scale.ascent;
    for (const auto& [number, other] : more_mela_names) {
        if (number == n) scale.names.emplace_back(other);
    }
    scale.sources = fmt::format("melakarta {}, chakra {}: S R{} G{} M{} P D{} N{}", n, chakras[chakra], r, g - 1,
                                m - 4, d, v - 1);
    return scale;
}

// --- all together -----------------------------------------------------------------------------------------------

constexpr std::size_t several = std::numeric_limits<std::size_t>::max();

struct Catalogue {
    std::vector<Scale> scales;
    std::unordered_map<std::string, std::size_t> keys;        ///< folded id, title or name → scale
    std::unordered_map<std::string, std::size_t> loose_keys;  ///< likewise for Indian scales; `several` if ambiguous
    std::unordered_map<std::string, std::vector<std::size_t>> ambiguous;  ///< folded word → scales

    Catalogue() {
        read(scales_txt);
        std::string_view names = mela_names;
        for (int n = 1; n <= 72; ++n) scales.push_back(melakarta(n, take_word(names)));
        for (std::size_t i = 0; i < scales.size(); ++i) {
            claim(scales[i].id, i);
            for (const std::string& name : scales[i].names) claim(name, i);
        }
        for (const auto& [word, ids] : words_) {
            std::vector<std::size_t>& meant = ambiguous[folded(word)];
            for (const std::string& id : ids) {
                const auto found = keys.find(folded(id));
                if (found == keys.end()) throw DataError(fmt::format("{} ? {}: there is no such id", word, id));
                meant.push_back(found->second);
            }
            if (keys.contains(folded(word))) throw DataError(fmt::format("'{}' is claimed and ambiguous", word));
        }
        for (std::size_t i = 0; i < scales.size(); ++i) {
            if (!ambiguous.contains(folded(scales[i].title))) claim(scales[i].title, i);
        }
        for (const auto& [key, ids] : ambiguous) loose_keys[loosely_folded(key)] = several;
        for (const auto& [key, i] : keys) {
            if (scales[i].group != "raga" && scales[i].group != "melakarta") continue;
            const auto [at, is_new] = loose_keys.emplace(loosely_folded(key), i);
            if (!is_new && at->second != i) at->second = several;
        }
    }

private:
    void claim(std::string_view name, std::size_t scale) {
        const auto [at, is_new] = keys.emplace(folded(name), scale);
        if (!is_new && at->second != scale) {
            throw DataError(fmt::format("{} and {} both claim '{}'", scales[at->second].id, scales[scale].id, name));
        }
    }

    void read(std::string_view text) {
        std::string group;
        int division = 12;
        int line_number = 0;
        while (!text.empty()) {
            std::string_view line = take_until(text, "\n");
            ++line_number;
            if (line.empty() || line.starts_with('#')) continue;
            try {
                if (line.starts_with('[')) {
                    group = take_until(line, "]").substr(1);
                    division = line.empty() ? 12 : static_cast<int>(number(trimmed(line)));
                } else if (const std::size_t mark = line.find(" ? "); line.find('|') == std::string_view::npos) {
                    if (mark == std::string_view::npos) throw DataError("neither scale nor word");
                    words_.push_back({std::string(line.substr(0, mark)), {}});
                    line.remove_prefix(mark + 3);
                    while (!line.empty()) words_.back().second.emplace_back(take_until(line, " "));
                } else {
                    read_scale(line, group, division);
                }
            } catch (const DataError& error) {
                throw DataError(fmt::format("scales.txt:{}: {}", line_number, error.what()));
            }
        }
    }

    void read_scale(std::string_view line, const std::string& group, int division) {
        Scale scale;
        scale.group = group;
        scale.id = take_until(line, "|");
        scale.title = title_of(scale.id);
        read_pitches(take_until(line, "|"), division, scale);
        for (std::string_view names = take_until(line, "|"); !names.empty();) {
            scale.names.emplace_back(take_until(names, ","));
        }
        scale.sources = trimmed(line);
        scales.push_back(std::move(scale));
    }

    std::vector<std::pair<std::string, std::vector<std::string>>> words_;
};

const Catalogue& catalogue() {
    static const Catalogue all;
    return all;
}

const Scale* find_key(const std::string& key) {
    const Catalogue& all = catalogue();
    const auto found = all.keys.find(key);
    return found == all.keys.end() ? nullptr : &all.scales[found->second];
}

/// The number in `mela29` or `melakarta029`, or 0.
int mela_number(std::string_view key) {
    for (const std::string_view prefix : {"melakarta", "mela"}) {
        if (!key.starts_with(prefix)) continue;
        const std::string_view digits = key.substr(prefix.size());
        int n = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
        const bool is_whole = error == std::errc() && end == digits.data() + digits.size();
        return is_whole && n >= 1 && n <= 72 ? n : 0;
    }
    return 0;
}

constexpr int most_steps = 1200;  // equal steps to the octave

/// The leading digits of a key.
std::string_view leading_digits(std::string_view key) {
    return key.substr(0, std::min(key.find_first_not_of("0123456789"), key.size()));
}

/// True for `31edo`, `31equal` or `31tet`, with any number.
bool names_equal_steps(std::string_view key) {
    const std::string_view rest = key.substr(leading_digits(key).size());
    return rest.size() < key.size() && (rest == "edo" || rest == "equal" || rest == "tet");
}

/// The number of equal steps to the octave; 0 if the key names none, or more than most_steps.
int equal_steps(std::string_view key) {
    if (!names_equal_steps(key)) return 0;
    int n = 0;
    const std::string_view digits = leading_digits(key);
    const std::errc error = std::from_chars(digits.data(), digits.data() + digits.size(), n).ec;
    return error == std::errc() && n <= most_steps ? n : 0;
}

/// True if hyphens or similar characters precede or divide the leading number: -5-edo and 3-1-edo are not scales.
bool splits_number(std::string_view name, std::string_view key) {
    return !trimmed(name).starts_with(leading_digits(key));
}

/// The equal division of the octave, created on first use. Thread-safe; the result stays valid.
const Scale* equal_scale(int steps) {
    static std::mutex mutex;
    static std::map<int, Scale> made;
    const std::lock_guard lock(mutex);
    const auto [at, is_new] = made.try_emplace(steps);
    Scale& scale = at->second;
    if (is_new) {
        scale.id = fmt::format("{}-equal", steps);
        scale.title = fmt::format("{} equal", steps);
        scale.group = "equal";
        scale.names = {fmt::format("{}-edo", steps), fmt::format("{}-tet", steps)};
        scale.sources = fmt::format("{} equal steps to the octave", steps);
        for (int step = 0; step < steps; ++step) scale.ascent.push_back(1200.0 * step / steps);
        scale.descent = scale.ascent;
    }
    return &scale;
}

/// Longer names are not looked up, as no scale has one.
constexpr std::size_t longest_name = 100;

/// The key without a leading `raga`, `ragam`, `raag` or `maqam`.
std::string without_kind(const std::string& key) {
    for (const std::string_view kind : {"ragam", "raga", "raag", "maqam"}) {
        if (key.starts_with(kind) && key.size() > kind.size()) return key.substr(kind.size());
    }
    return key;
}

/// The note of `notes`, in any period, nearest to `cents` in one direction; `cents` itself if it is a note.
double next_note(const std::vector<double>& notes, double period, double cents, bool falling) {
    const double step = std::fabs(period);
    double best = falling ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    for (const double note : notes) {
        const double away = (cents - note) / step;
        const double slack = same_note / step;
        const double found = note + step * (falling ? std::floor(away + slack) : std::ceil(away - slack));
        best = falling ? std::max(best, found) : std::min(best, found);
    }
    return best;
}

}  // namespace

double Scale::cents(std::int64_t degree, bool falling) const {
    const bool both = !ascent.empty() && !descent.empty();
    const std::vector<double>& own = (falling && !descent.empty()) || ascent.empty() ? descent : ascent;
    if (own.empty()) return static_cast<double>(degree) * period;  // the tonic alone
    const std::vector<double>& longer = both && descent.size() > ascent.size() ? descent : ascent;
    const std::vector<double>& counted = both && ascent.size() != descent.size() ? longer : own;
    const auto count = static_cast<std::int64_t>(counted.size());
    const std::int64_t turn = floor_divide(degree, count);
    const double cents =
        counted[static_cast<std::size_t>(degree - turn * count)] + static_cast<double>(turn) * period;
    return &counted == &own ? cents : next_note(own, period, cents, falling);
}

std::size_t Scale::size() const {
    return std::max<std::size_t>({ascent.size(), descent.size(), 1});
}

const std::vector<Scale>& known_scales() {
    return catalogue().scales;
}

const Scale* find_scale(std::string_view name) {
    if (name.size() > longest_name) return nullptr;
    const Catalogue& all = catalogue();
    const std::string key = folded(name);
    if (key.empty() || splits_number(name, key)) return nullptr;
    if (const int n = mela_number(key)) return find_key(fmt::format("mela{}", n));
    // An ambiguous word finds no scale, however it is spelled.
    const std::string bare = without_kind(key);
    for (const std::string& one : {key, bare}) {
        if (const Scale* scale = find_key(one)) return scale;
        if (all.ambiguous.contains(one)) return nullptr;
    }
    for (const std::string& one : {key, bare}) {
        const auto found = all.loose_keys.find(loosely_folded(one));
        if (found != all.loose_keys.end()) return found->second == several ? nullptr : &all.scales[found->second];
    }
    if (const int steps = equal_steps(key)) return equal_scale(steps);
    return nullptr;
}

std::vector<std::string> similar_scales(std::string_view name) {
    constexpr std::size_t most = 3;
    if (name.size() > longest_name) return {};
    const Catalogue& all = catalogue();
    const std::string key = folded(name);
    std::vector<std::string> result;
    if (key.empty()) return result;
    for (const std::string& one : {key, without_kind(key)}) {
        const auto meant = all.ambiguous.find(one);
        if (meant == all.ambiguous.end()) continue;
        for (const std::size_t scale : meant->second) {
            if (result.size() < most) result.push_back(all.scales[scale].id);
        }
        return result;
    }

    // Finds the nearest word of each scale, then the nearest of these.
    const std::size_t enough = std::max<std::size_t>(1, key.size() / 3);
    std::vector<std::pair<std::size_t, std::string>> found;
    for (const Scale& scale : all.scales) {
        std::size_t nearest_distance = enough + 1;
        const std::string* nearest_word = nullptr;
        const auto compare = [&](const std::string& word) {
            const std::string other = folded(word);
            if (other.size() > key.size() + enough || key.size() > other.size() + enough) return;
            const std::size_t slips = edit_distance(key, other);
            if (slips >= nearest_distance) return;
            nearest_distance = slips;
            nearest_word = &word;
        };
        compare(scale.id);
        for (const std::string& word : scale.names) compare(word);
        compare(scale.title);
        if (nearest_word) found.emplace_back(nearest_distance, *nearest_word);
    }
    if (found.empty() && key.size() >= 4) {
        for (const Scale& scale : all.scales) {
            if (folded(scale.id).find(key) != std::string::npos) found.emplace_back(0, scale.id);
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [slips, word] : found) {
        if (result.size() < most) result.push_back(word);
    }
    return result;
}

std::string unknown_scale(std::string_view name) {
    const std::string problem = fmt::format("unknown scale '{}'", printable(name, 80));
    const std::string key = name.size() > longest_name ? "" : folded(name);
    if (names_equal_steps(key)) {
        return problem + (equal_steps(key) == 0 ? fmt::format(": an octave has 1 to {} equal steps", most_steps)
                                                : did_you_mean(fmt::format("{}-edo", equal_steps(key))));
    }
    const std::size_t blank = name.find(' ');
    const bool begins_with_tonic = (blank == 1 || (blank == 2 && (name[1] == '#' || name[1] == 'b'))) &&
                                   std::string_view("ABCDEFGabcdefg").find(name[0]) != std::string_view::npos;
    if (begins_with_tonic && find_scale(name.substr(blank + 1))) {
        return problem + fmt::format("; set the tonic separately: `scale: {}`, `tonic: {}{}`", name.substr(blank + 1),
                                     static_cast<char>(std::toupper(name[0])), name.substr(1, blank - 1));
    }
    const std::vector<std::string> similar = similar_scales(name);
    const std::vector<std::string_view> near(similar.begin(), similar.end());
    return problem + (near.empty() ? "; `sikku scales` lists the bundled scales" : did_you_mean(near));
}

}  // namespace sikku
