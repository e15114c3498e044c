#include "music/melody/symbol_table.h"

#include "engine/base/text.h"
#include "music/melody/chord_names.h"
#include "music/melody/key_values.h"
#include "music/melody/melody.h"
#include "music/score/drums.h"
#include "music/score/dynamics.h"
#include "music/score/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace sikku {
namespace {

using Kind = SymbolRow::Kind;

constexpr std::size_t most_pitches = 10;
constexpr double most_steps = 1'000'000;
constexpr std::int64_t most_degree = 1000;
constexpr int softest = 1;
constexpr int loudest = 127;

struct KindName {
    std::string_view key;
    Kind kind;
};
constexpr std::array<KindName, 5> kinds = {{{"note ", Kind::note},
                                            {"drum ", Kind::drum},
                                            {"chord ", Kind::chord},
                                            {"rest ", Kind::rest},
                                            {"change ", Kind::change}}};

/// The velocity of `ppp` to `fff`.
std::optional<int> level_of(std::string_view name) {
    constexpr int levels = 8;
    constexpr int step = 16;
    for (int level = 0; level < levels; ++level) {
        if (dynamic_name(level) == name) return std::min(loudest, step * (level + 1));
    }
    return std::nullopt;
}

/// The degree nearest to a pitch in cents above the tonic.
std::int64_t nearest_degree(const Scale& scale, double cents) {
    const auto size = static_cast<std::int64_t>(scale.size());
    const double period = std::fabs(scale.period);
    if (size == 0 || !(period > 0) || !(std::fabs(cents) < 1e6)) return 0;
    const auto first = static_cast<std::int64_t>(std::floor(cents / period)) * size - size;
    std::int64_t best = first;
    const auto distance = [&](std::int64_t degree) { return std::fabs(scale.cents(degree, false) - cents); };
    for (std::int64_t degree = first; degree <= first + 3 * size; ++degree) {
        if (distance(degree) < distance(best) - 1e-9) best = degree;
    }
    return best;
}

/// Key of a symbol that names a note: a letter from A to G, optional `b` or `s` (sharp), and an octave, by default 4.
std::optional<double> named_key(std::string_view symbol) {
    if (symbol.empty() || symbol.front() < 'A' || symbol.front() > 'G') return std::nullopt;
    std::string name(symbol);
    std::replace(name.begin() + 1, name.end(), 's', '#');
    const auto note = parse_note(name);
    if (!note || note->key < 0 || note->key > 127) return std::nullopt;
    return note->key;
}

TablePitch pitch_of_key(const Melody& melody, double key) {
    const std::int64_t degree = melody.keys ? static_cast<std::int64_t>(std::llround(key - melody.keys->middle))
                                            : nearest_degree(melody.scale, 100 * (key - melody.tonic));
    return {degree, key};
}

class TableReader : private KeyReader {
public:
    TableReader(const Pattern& pattern, Melody& melody, Diagnostics& diagnostics)
        : KeyReader(pattern, diagnostics), melody_(melody) {}

    void read() {
        read_names();
        for (const Key& key : pattern_.keys) {
            for (const KindName& kind : kinds) {
                if (key.name.starts_with(kind.key)) read_row(key, kind);
            }
        }
        if (const Key* key = pattern_.find("named notes")) {
            const std::string word = lower_case(key->value.view());
            melody_.table.has_named_notes = word == "yes";
            if (word != "yes" && word != "no") fail(*key, "expected no or yes");
        }
        warn_without_mapping();
    }

private:
    void read_names() {
        const Key* key = pattern_.find("symbols");
        if (!key) return;
        for (const std::string_view name : split_words(key->value.view())) names_.emplace(name);
    }

    /// True for one character, `@` with another, a listed name or a surface.
    bool is_symbol(std::string_view text) const {
        if (text.empty() || names_.contains(std::string(text))) return !text.empty();
        if (text.front() == '~' && text.size() > 1) return true;
        if (text.front() == '@') text.remove_prefix(1);
        return !text.empty() && utf8_length(text) == text.size() &&
               std::string_view("()<>:*").find(text.front()) == std::string_view::npos;
    }

    void read_row(const Key& key, const KindName& kind) {
        SymbolRow row;
        row.symbol = key.name.substr(kind.key.size());
        row.kind = kind.kind;
        if (!is_symbol(row.symbol)) {
            return diagnostics_.error(
                key.name_at,
                fmt::format("'{}' is not one symbol; names of several letters are listed under 'symbols:'",
                            row.symbol));
        }
        if (row.symbol == "[" || row.symbol == "]") {
            return diagnostics_.error(key.name_at, "brackets begin and end branches; expected another symbol");
        }
        const auto [known, is_new] = keys_.try_emplace(row.symbol, key.name);
        if (!is_new) {
            return diagnostics_.error(key.name_at, fmt::format("'{}' is defined twice: '{}:' states what it sounds",
                                                               row.symbol, known->second));
        }
        const std::vector<std::string_view> words = split_words(key.value.view());
        std::string problem;
        switch (row.kind) {
            case Kind::note:
                problem = read_note(words, row);
                break;
            case Kind::drum:
                problem = read_drum(words, row);
                break;
            case Kind::chord:
                problem = read_chord(words, row);
                break;
            case Kind::rest:
                problem = read_ending(words, 0, false, row);
                break;
            case Kind::change:
                problem = read_change(words, row);
                break;
        }
        if (!problem.empty()) return fail(key, problem);
        melody_.table.rows.push_back(std::move(row));
    }

    /// Reads a note value with a `/`, and a velocity, from word `at` on. @return the problem; empty if there is none
    std::string read_ending(const std::vector<std::string_view>& words, std::size_t at, bool has_velocity,
                            SymbolRow& row) const {
        if (at < words.size() && words[at].find('/') != std::string_view::npos) {
            const auto ticks = note_value(words[at]);
            if (!ticks) {
                return fmt::format(
                    "unknown duration '{}'; expected a note value above 0, such as 1/8, 3/16 or 1/1, up "
                    "to 16 whole notes",
                    words[at]);
            }
            row.steps = static_cast<double>(*ticks) / static_cast<double>(melody_.unit);
            ++at;
        }
        if (has_velocity && at < words.size()) {
            const auto level = level_of(words[at]);
            const auto number = whole_number(words[at]);
            if (!level && number && (*number < softest || *number > loudest)) {
                return fmt::format("velocity {}; expected 1 to 127, or ppp to fff", *number);
            }
            if (level || number) {
                row.velocity = level ? *level : static_cast<int>(*number);
                row.is_dynamic = level.has_value();
                ++at;
            }
        }
        if (at == words.size()) return {};
        return has_velocity ? fmt::format(
                                  "unexpected '{}'; expected a note value such as 1/8, then a velocity such as "
                                  "mf or 90",
                                  words[at])
                            : fmt::format("unexpected '{}'; expected a note value such as 1/8", words[at]);
    }

    std::string read_degree(std::string_view word, SymbolRow& row) const {
        const auto degree = whole_number(word.starts_with('+') ? word.substr(1) : word);
        if (!degree || *degree < -most_degree || *degree > most_degree) {
            return fmt::format("unknown degree '{}'; expected a whole number from -{} to {}; 0 is the tonic", word,
                               most_degree, most_degree);
        }
        row.pitches.push_back({*degree, std::nullopt});
        return {};
    }

    /// Adds a pitch if `word` is the name of a note. @param problem  receives its problem
    bool read_name(std::string_view word, SymbolRow& row, std::string& problem) const {
        const auto note = parse_note(word);
        if (!note) return false;
        if (note->key < 0 || note->key > 127) {
            problem = fmt::format("{} lies beyond what MIDI can write; expected C-1 to G9", word);
        } else {
            row.pitches.push_back(pitch_of_key(melody_, note->key));
        }
        return true;
    }

    std::string read_note(const std::vector<std::string_view>& words, SymbolRow& row) const {
        std::string problem;
        std::size_t at = 0;
        const bool has_value = !words.empty() && (words[0].find('/') != std::string_view::npos || level_of(words[0]));
        if (words.size() > 1 && words[0] == "degree" && whole_word(words[1])) {
            problem = read_degree(words[1], row);
            at = 2;
        } else if (!words.empty() && words[0] == "degree") {
            at = 1;
        } else if (!words.empty() && !has_value) {
            if (!read_name(words[0], row, problem)) {
                return fmt::format("unknown pitch '{}'; expected a note such as C4, F#3 or Bb, or degree 3",
                                   words[0]);
            }
            at = 1;
        }
        return problem.empty() ? read_ending(words, at, true, row) : problem;
    }

    /// True for a word that is neither a note value nor a dynamic, and so should be the number of a degree.
    static bool whole_word(std::string_view word) {
        return word.find('/') == std::string_view::npos && !level_of(word);
    }

    std::string read_chord(const std::vector<std::string_view>& words, SymbolRow& row) const {
        if (words.empty()) {
            return "expected a chord: a numeral such as IV or V7, a name such as Am7, notes such as C4 E4 G4, or "
                   "degrees 0 2 4";
        }
        std::string problem;
        std::size_t at = 0;
        if (words[0] == "degrees") {
            for (at = 1; at < words.size() && whole_word(words[at]); ++at) {
                if (problem = read_degree(words[at], row); !problem.empty()) return problem;
            }
        } else {
            while (at < words.size() && read_name(words[at], row, problem)) ++at;
            // A chord of one note is a chord by name, as `C7` is.
            if (at == 1 && is_chord_and_note(words[0])) {
                row.pitches.clear();
                at = 0;
            } else if (!problem.empty()) {
                return problem;
            }
        }
        if (at == 0) {
            // Named chords may contain pitches outside the scale, as sevenths do.
            const auto chord = named_chord(words[0], melody_.scale, melody_.tonic);
            if (!chord) {
                return fmt::format(
                    "unknown chord '{}'; expected a numeral such as IV or V7, a name such as Am7, notes "
                    "such as C4 E4 G4, or degrees 0 2 4",
                    printable(words[0]));
            }
            if (melody_.keys) return "chords by numeral or name cannot be combined with 'keyboard:'";
            for (const double cents : chord->cents) {
                row.pitches.push_back(pitch_of_key(melody_, melody_.tonic + cents / 100));
            }
            row.named = chord;
            at = 1;
        }
        if (row.pitches.empty()) return "expected degrees such as 0 2 4";
        if (row.pitches.size() > most_pitches) return fmt::format("a chord has at most {} notes", most_pitches);
        return read_ending(words, at, true, row);
    }

    /// Reads drums separated by `+`. Note value and velocity follow the last, whose name may end in a number.
    std::string read_drum(const std::vector<std::string_view>& words, SymbolRow& row) const {
        std::size_t begin = 0;
        for (;;) {
            const auto plus = std::find(words.begin() + static_cast<std::ptrdiff_t>(begin), words.end(), "+");
            const auto end = static_cast<std::size_t>(plus - words.begin());
            const bool is_last = end == words.size();
            const Drum* drum = nullptr;
            std::size_t after = end;
            for (; after > begin; --after) {
                drum =
                    find_drum(fmt::format("{}", fmt::join(words.begin() + static_cast<std::ptrdiff_t>(begin),
                                                          words.begin() + static_cast<std::ptrdiff_t>(after), " ")));
                if (drum || !is_last) break;
            }
            if (!drum) return unknown_drum(words, begin, end);
            row.pitches.push_back({0, drum->key});
            if (row.pitches.size() > most_pitches)
                return fmt::format("a symbol sounds at most {} drums", most_pitches);
            if (is_last) return read_ending(words, after, true, row);
            begin = end + 1;
        }
    }

    static std::string unknown_drum(const std::vector<std::string_view>& words, std::size_t begin, std::size_t end) {
        std::string name;
        for (std::size_t i = begin; i < end; ++i) {
            if (words[i].find('/') != std::string_view::npos || (i > begin && level_of(words[i]))) break;
            name += (name.empty() ? "" : " ") + std::string(words[i]);
        }
        constexpr std::string_view expected =
            "expected a drum of General MIDI such as bass drum, or its key, 35 to 81";
        if (name.empty()) return std::string(expected);
        std::vector<std::string> folded;
        for (const Drum& drum : drums()) {
            folded.push_back(lower_case(drum.name));
            if (!drum.alias.empty()) folded.emplace_back(drum.alias);
        }
        const std::vector<std::string_view> known(folded.begin(), folded.end());
        // Common short names of drums.
        static constexpr std::array<std::pair<std::string_view, std::string_view>, 6> usual = {
            {{"kick", "bass drum"},
             {"snare", "snare drum"},
             {"ride", "ride cymbal"},
             {"crash", "crash cymbal"},
             {"hat", "hi-hat"},
             {"tom", "low tom"}}};
        std::string_view near = nearest(lower_case(name), known);
        for (const auto& [word, drum] : usual) {
            if (word == lower_case(name)) near = drum;
        }
        return near.empty() ? fmt::format("unknown drum '{}'; {}", name, expected)
                            : fmt::format("unknown drum '{}'{}", name, did_you_mean(near));
    }

    static std::string read_change(const std::vector<std::string_view>& words, SymbolRow& row) {
        constexpr double usual = 12;  // default change of velocity
        const std::string_view first = words.empty() ? std::string_view() : words[0];
        const auto level = level_of(first);
        std::size_t at = 1;
        double sign = 1;
        row.amount = 1;
        if (first == "louder" || first == "softer") {
            row.change = SoundChange::velocity;
            row.amount = usual;
            sign = first == "louder" ? 1 : -1;
        } else if (first == "octave") {
            // `octave up`, `octave down 2`, `octave -1`, or `octave` alone for up.
            row.change = SoundChange::octave;
            const std::string_view second = words.size() > 1 ? words[1] : std::string_view();
            const bool has_direction = second == "up" || second == "down";
            const auto number = whole_number(second);
            sign = second == "down" || (number && *number < 0) ? -1 : 1;
            if (number) row.amount = std::fabs(static_cast<double>(*number));
            at = has_direction || number ? 2 : 1;
            if (number && words.size() > at) return fmt::format("unexpected '{}'", words[at]);
            if (row.amount > loudest)
                return fmt::format("unexpected '{}'; expected an amount from 0 to 127", words[1]);
        } else if (first == "loud" || first == "soft") {
            row.change = SoundChange::level;
            row.amount = *level_of(first == "loud" ? "f" : "p");
            row.is_dynamic = true;
        } else if (first == "up" || first == "down") {
            row.change = SoundChange::degree;
            sign = first == "up" ? 1 : -1;
        } else if (const auto number = whole_number(first); level || number) {
            row.change = SoundChange::level;
            row.amount = level ? *level : static_cast<double>(*number);
            row.is_dynamic = level.has_value();
            if (row.amount < softest || row.amount > loudest) {
                return fmt::format("velocity {}; expected 1 to 127, or ppp to fff", row.amount);
            }
        } else {
            return "expected loud or soft, louder or softer, a velocity such as mf or 90, octave up or octave down, "
                   "up 2 or "
                   "down 2";
        }
        if (at < words.size() && row.change != SoundChange::level) {
            const auto amount = whole_number(words[at]);
            if (!amount || *amount < 0 || *amount > loudest) {
                return fmt::format("unexpected '{}'; expected an amount from 0 to 127", words[at]);
            }
            row.amount = static_cast<double>(*amount);
            ++at;
        }
        if (at < words.size()) return fmt::format("unexpected '{}'", words[at]);
        row.amount *= sign;
        return {};
    }

    void warn_without_mapping() {
        if (melody_.mapping == Mapping::symbols) return;
        for (const Key& key : pattern_.keys) {
            const bool is_row = std::any_of(kinds.begin(), kinds.end(),
                                            [&](const KindName& kind) { return key.name.starts_with(kind.key); });
            if (!is_row && key.name != "named notes") continue;
            diagnostics_.warning(key.name_at,
                                 fmt::format("'{}:' has no meaning without `mapping: symbols`", key.name));
            return;
        }
    }

    Melody& melody_;
    std::set<std::string> names_;
    std::map<std::string, std::string> keys_;  // key that states each symbol
};

/// Replaces the values of a row by the parameters of a module. @return the problem; empty if there is none
std::string apply_parameters(const std::vector<double>& parameters, SymbolRow& row) {
    std::size_t at = 0;
    const auto next = [&]() -> std::optional<double> {
        return at < parameters.size() ? std::optional(parameters[at++]) : std::nullopt;
    };
    if (row.kind == Kind::change) {
        const auto amount = next();
        if (!amount) return {};
        const bool is_level = row.change == SoundChange::level;
        const double least = is_level ? softest : -loudest;
        if (!(*amount >= least && *amount <= loudest)) {
            return fmt::format("its parameter is {}; expected {} to 127", *amount, least);
        }
        row.amount = is_level || row.amount >= 0 ? *amount : -*amount;
        row.is_dynamic = false;
        return {};
    }
    if (row.kind == Kind::note && row.pitches.empty()) {
        const auto degree = next();
        if (!(std::fabs(degree.value_or(0)) <= 1e15)) return "its degree is not finite";
        row.pitches.push_back({std::llround(degree.value_or(0)), std::nullopt});
    }
    if (const auto steps = next()) {
        if (!(*steps > 0 && *steps <= most_steps)) {
            return fmt::format("its duration is {}; expected steps above 0, up to 1000000", *steps);
        }
        row.steps = *steps;
    }
    if (const auto velocity = next(); velocity && row.is_sounding()) {
        if (!(*velocity >= softest && *velocity <= loudest)) {
            return fmt::format("its velocity is {}; expected 1 to 127", *velocity);
        }
        row.velocity = static_cast<int>(std::lround(*velocity));
        row.is_dynamic = false;
    }
    return {};
}

}  // namespace

int SymbolTable::most_notes() const {
    std::size_t most = 1;
    for (const SymbolRow& row : rows) most = std::max(most, row.pitches.size());
    return static_cast<int>(most);
}

void read_symbol_table(const Pattern& pattern, Melody& melody, Diagnostics& diagnostics) {
    TableReader(pattern, melody, diagnostics).read();
}

std::vector<SymbolEntry> entries_of(const Grammar& grammar, const Melody& melody) {
    std::vector<SymbolEntry> entries;
    const SymbolTable& table = melody.table;
    if (table.empty() || melody.mapping != Mapping::symbols) return entries;
    std::map<std::string_view, const SymbolRow*> rows;
    for (const SymbolRow& row : table.rows) rows.emplace(row.symbol, &row);
    for (const SymbolInfo& symbol : grammar.symbols()) {
        SymbolEntry& entry = entries.emplace_back();
        const auto row = rows.find(symbol.letter);
        const auto key = row == rows.end() && table.has_named_notes ? named_key(symbol.letter) : std::nullopt;
        if (row == rows.end() && !key) continue;
        entry.has_row = true;
        if (key) {
            entry.row.symbol = symbol.letter;
            entry.row.pitches.push_back(pitch_of_key(melody, *key));
        } else {
            entry.row = *row->second;
        }
        entry.problem = apply_parameters(symbol.arguments, entry.row);
    }
    return entries;
}

std::vector<std::string> unused_rows(const Grammar& grammar, const SymbolTable& table) {
    std::vector<std::string> unused;
    const std::vector<std::string>& letters = grammar.letters();
    for (const SymbolRow& row : table.rows) {
        if (std::find(letters.begin(), letters.end(), row.symbol) == letters.end()) unused.push_back(row.symbol);
    }
    return unused;
}

SoundKinds sound_kinds(const Grammar& grammar, const Melody& melody) {
    SoundKinds sounds;
    const std::vector<SymbolEntry> entries = entries_of(grammar, melody);
    if (entries.empty()) return sounds;
    const std::vector<char> reached = grammar.reachable();
    sounds.has_pitches = false;
    for (std::size_t symbol = 0; symbol < reached.size(); ++symbol) {
        if (!reached[symbol]) continue;
        const SymbolEntry& entry = entries[symbol];
        const Action action = grammar.symbols()[symbol].command.action;
        if (!entry.has_row) {
            sounds.has_pitches = sounds.has_pitches || action == Action::draw;
        } else if (entry.row.is_drum()) {
            sounds.has_drums = true;
        } else if (entry.row.is_sounding()) {
            sounds.has_pitches = true;
        }
    }
    return sounds;
}

}  // namespace sikku
