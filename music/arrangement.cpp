#include "music/arrangement.h"

#include "engine/base/diagnostic.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"
#include "engine/language/arrangement_library.h"
#include "music/melody/melody.h"
#include "music/players.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Text as a TOML string on one line.
std::string toml_string(std::string_view text) {
    std::string result = "\"";
    for (const char letter : text) {
        if (letter == '"' || letter == '\\') {
            result += '\\';
            result += letter;
        } else if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F) {
            result += fmt::format("\\u{:04X}", static_cast<int>(letter));
        } else {
            result += letter;
        }
    }
    return result + '"';
}

/// Text as a TOML string that keeps its lines, if its characters allow that.
std::string toml_text(std::string_view text) {
    const bool is_plain = std::none_of(text.begin(), text.end(), [](char letter) {
        return (static_cast<unsigned char>(letter) < 0x20 && letter != '\n' && letter != '\t') || letter == 0x7F;
    });
    if (!is_plain || text.find("'''") != std::string_view::npos || text.ends_with('\'')) return toml_string(text);
    return fmt::format("'''\n{}'''", text);
}

std::string pattern_table(std::string_view name, std::string_view text) {
    return fmt::format("\n[[pattern]]\nname = {}\ntext = {}\n", toml_string(name), toml_text(text));
}

/// The main name of a key, with blanks for hyphens and underscores. Keeps the symbol of keys such as `note SYMBOL`.
std::string folded(std::string_view key) {
    std::string result = lower_case(key);
    std::replace(result.begin(), result.end(), '-', ' ');
    std::replace(result.begin(), result.end(), '_', ' ');
    if (const KeyInfo* row = find_language_key(result); row && row->is_for_symbols()) {
        const std::size_t before = row->before_symbol().size();
        return result.substr(0, before) + std::string(key.substr(before));
    }
    if (result == "tempo ratio") return "speed";
    return result == "transpose" ? "transposition" : result;
}

const KeyInfo* music_key(std::string_view name) {
    const KeyInfo* known = find_language_key(name);
    return known && known->owner == KeyOwner::music ? known : nullptr;
}

/// The text of a value. @throws FileError for tables, and for lists of other keys than `canon`
std::string text_of(const std::string& key, const FileValue& value) {
    if (value.type == FileValue::Type::list && key == "canon") {
        std::string text;
        for (const FileValue& one : value.list) {
            if (one.type != FileValue::Type::text) fail(one, "canon: expected text such as \"2 -12\"");
            text += (text.empty() ? "" : ", ") + one.text;
        }
        return text;
    }
    if (value.type != FileValue::Type::text) fail(value, fmt::format("{}: expected a text or a number", key));
    return value.text;
}

/// A key with the value that sets it.
struct PlacedSetting {
    Setting setting;
    const FileValue* value;
};

class ArrangementReader {
public:
    ArrangementReader(const std::string& file, const std::string& text, const PatternReader& read)
        : file_(file), text_(text), read_(read) {}

    Arrangement read() {
        const FileValue root = read_toml(file_, text_);
        const FileValue* tracks = nullptr;
        const FileValue* form = nullptr;
        for (const auto& [key, value] : root.table) {
            if (key != "item") continue;
            fail(value,
                 "a gallery file has [[item]], an arrangement has [[track]]; `sikku gallery` takes a gallery file");
        }
        for (const auto& [key, value] : root.table) {
            const std::string name = folded(key);
            if (name == "track") {
                tracks = &value;
            } else if (name == "form") {
                form = &value;
            } else if (name == "section") {
                collect([&, &value = value] { read_sections(value); });
            } else {
                collect([&, &key = key, &value = value] { read_head(name, key, value); });
            }
        }
        if (form) collect([&] { read_form_of_piece(*form); });
        collect([&] { check_number(tracks); });
        const bool is_list = tracks && tracks->type == FileValue::Type::list && tracks->list.size() <= most_tracks;
        if (!is_list) throw_if_any();
        result_.text = text_;
        for (const FileValue& track : tracks->list) {
            collect([&] { read_track(track); });
        }
        throw_if_any();
        add_remarks();
        check_sections(*tracks, form);
        throw_if_any();
        read_section_tempos();
        return std::move(result_);
    }

private:
    /// Continues after an error, so that all errors are reported together.
    template <typename Read>
    void collect(Read&& read) {
        try {
            read();
        } catch (const FileError& error) {
            add(error);
        } catch (const PatternError& error) {
            if (errors_.empty()) throw;
            add(FileError(error.what()));
            throw_if_any();
        }
    }

    /// @throws FileError
    void check_number(const FileValue* tracks) const {
        if (!tracks || tracks->type != FileValue::Type::list || tracks->list.empty()) {
            const std::string needed = "an arrangement has at least one [[track]]";
            if (tracks) fail(*tracks, needed);
            fail(file_, needed);
        }
        if (tracks->list.size() > most_tracks) {
            fail(*tracks, fmt::format("too many tracks: an arrangement has at most {}, and this one {}", most_tracks,
                                      tracks->list.size()));
        }
    }

    /// Adds an error unless it is known: settings of the head apply to every track, so their errors recur.
    void add(const FileError& error) {
        const std::string_view text = error.what();
        const bool is_new =
            std::none_of(errors_.begin(), errors_.end(), [&](const FileError& one) { return one.what() == text; });
        if (is_new) errors_.push_back(error);
    }

    void throw_if_any() {
        constexpr std::size_t most_shown = 20;
        if (errors_.empty()) return;
        std::stable_sort(errors_.begin(), errors_.end(),
                         [](const FileError& a, const FileError& b) { return a.order() < b.order(); });
        const std::size_t shown = std::min(errors_.size(), most_shown);
        std::string text;
        for (std::size_t i = 0; i < shown; ++i) text += (i > 0 ? "\n" : "") + std::string(errors_[i].what());
        if (const std::size_t hidden = errors_.size() - shown; hidden > 0) {
            text += fmt::format("\n{} more {} not shown", hidden, hidden == 1 ? "error is" : "errors are");
        }
        throw FileError(text);
    }

    void read_head(const std::string& name, const std::string& key, const FileValue& value) {
        if (name == "pattern") {
            read_patterns(value);
        } else if (name == "title" || name == "composer" || name == "source") {
            (name == "title"      ? result_.title
             : name == "composer" ? result_.composer
                                  : result_.source) = text_of(name, value);
        } else if (music_key(name)) {
            shared_.push_back({part_setting(name, text_of(name, value)), &value});
        } else {
            refuse_key(value, key, Place::piece);
        }
    }

    void read_form_of_piece(const FileValue& form) {
        result_.form = read_form(text_of("form", form));
        const bool is_changed = std::any_of(result_.form.begin(), result_.form.end(),
                                            [](const FormSection& section) { return section.is_changed(); });
        if (is_changed)
            fail(form, "form: sections of a piece are played as they are; the `form` of a track can change its own");
        if (!result_.form.empty()) return;
        fail(form, "form: expected sections such as A A B A, or A1 A2 B A2 with open (1) and closed (2) endings");
    }

    /// Where a key stands.
    enum class Place { piece, section, track };

    [[noreturn]] static void refuse_key(const FileValue& value, const std::string& key, Place place) {
        static constexpr std::array<std::string_view, 6> of_track = {"n",   "seed",    "variant",
                                                                     "set", "pattern", "section"};
        const std::string name = folded(key);
        if (place == Place::section && std::find(of_track.begin(), of_track.end(), name) != of_track.end()) {
            fail(value, fmt::format("'{}' belongs to a track", name));
        }
        std::vector<std::string_view> known = {"name", "transpose", "tempo ratio"};
        if (place != Place::section) known.insert(known.end(), of_track.begin(), of_track.end());
        for (const std::string_view one : keys_of(KeyOwner::music)) known.push_back(one);
        if (place == Place::piece) known.insert(known.end(), {"title", "composer", "source", "form", "track"});
        const std::string_view near = name == "bpm" ? "tempo" : name == "key" ? "tonic" : nearest(name, known);
        fail(value, fmt::format("unknown key '{}'{}", printable(key), did_you_mean(near)));
    }

    /// Keys of a section.
    struct Section {
        std::vector<PlacedSetting> settings;
        const FileValue* place = nullptr;
    };

    static void read_key_of_section(const std::string& key, const FileValue& value, Section& section) {
        const std::string known = folded(key);
        if (known == "name") return;
        if (known == "ending") fail(value, "ending belongs to the whole piece, above the first track");
        if (!music_key(known)) refuse_key(value, key, Place::section);
        section.settings.push_back({part_setting(known, text_of(known, value)), &value});
    }

    /// Reads the keys of sections.
    void read_sections(const FileValue& value) {
        if (value.type != FileValue::Type::list) fail(value, "section: expected [[section]] tables");
        for (const FileValue& one : value.list) {
            if (one.type != FileValue::Type::table) fail(value, "section: expected [[section]] tables");
            const auto name = std::find_if(one.table.begin(), one.table.end(),
                                           [](const auto& entry) { return entry.key == "name"; });
            if (name == one.table.end())
                fail(one, "this section has no name; expected a letter such as name = \"B\"");
            const char letter = section_of("name", name->value);
            const auto found = sections_.try_emplace(letter);
            if (!found.second) fail(one, fmt::format("two sections are named {}", letter));
            Section& section = found.first->second;
            section.place = &name->value;
            for (const auto& [key, inner] : one.table) {
                collect([&, &key = key, &inner = inner] { read_key_of_section(key, inner, section); });
            }
        }
    }

    void read_patterns(const FileValue& value) {
        if (value.type != FileValue::Type::list) fail(value, "pattern: expected [[pattern]] tables");
        for (const FileValue& one : value.list) {
            std::string name;
            const FileValue* text = nullptr;
            if (one.type != FileValue::Type::table) fail(one, "pattern: expected [[pattern]] tables");
            for (const auto& [key, inner] : one.table) {
                if (key != "name" && key != "text")
                    fail(inner, fmt::format("unknown key '{}'; expected name and text", printable(key)));
                if (inner.type != FileValue::Type::text) fail(inner, key + ": expected a text");
                if (key == "name") name = inner.text;
                if (key == "text") text = &inner;
            }
            if (name.empty() || !text) fail(one, "a [[pattern]] has a name and a text");
            if (!known_.try_emplace(name, NamedPattern{name, text->text}).second) {
                fail(one, fmt::format("two patterns are named '{}'", printable(name)));
            }
            inner_.push_back(name);
        }
    }

    const NamedPattern& pattern(const std::string& name, const FileValue& value) {
        const auto known = known_.find(name);
        if (known != known_.end()) return known->second;
        const auto refuse_arrangement = [&] {
            fail(value, fmt::format("{}: a track plays a pattern, not another arrangement", printable(name)));
        };
        if (lower_case(name).ends_with(".toml")) refuse_arrangement();
        NamedPattern found;
        try {
            found = read_(name);
        } catch (const std::runtime_error& error) {
            if (bundled_arrangement(name)) refuse_arrangement();
            fail(value, error.what());
        }
        result_.text += pattern_table(name, found.text);
        return known_.emplace(name, std::move(found)).first->second;
    }

    static std::string part_name(const FileValue& value) {
        constexpr std::size_t most_bytes = 100;
        const auto is_control = [](char byte) { return static_cast<unsigned char>(byte) < 0x20 || byte == 0x7F; };
        if (value.type != FileValue::Type::text || value.text.empty() || value.text.size() > most_bytes ||
            std::any_of(value.text.begin(), value.text.end(), is_control)) {
            fail(value, fmt::format("name: expected a line of 1 to {} bytes of text", most_bytes));
        }
        return value.text;
    }

    /// @throws FileError for keys of the whole piece
    static void refuse_whole(const std::string& key, const FileValue& value) {
        if (key != "tempo" && key != "ending") return;
        fail(value, fmt::format("{} belongs to the whole piece, above the first track{}", key,
                                key == "tempo" ? "; `speed = \"3:2\"` gives a track a tempo of its own" : ""));
    }

    /// Keys and values of a track.
    struct TrackKeys {
        std::vector<PlacedSetting> settings;
        Overrides overrides;
        std::string pattern;
        const FileValue* pattern_value = nullptr;
        const FileValue* variant_value = nullptr;
        std::string name;
        char section = 0;
    };

    static char section_of(const std::string& key, const FileValue& value) {
        const auto letters = read_form(text_of(key, value));
        if (letters.size() != 1 || letters.front().ending != Ending::none || letters.front().is_changed()) {
            fail(value, key + ": expected a letter from A to Z");
        }
        return static_cast<char>('A' + letters.front().letter);
    }

    static void read_key(const std::string& key, const FileValue& value, TrackKeys& track) {
        const std::string known = folded(key);
        refuse_whole(known, value);
        if (known == "pattern") {
            track.pattern_value = &value;
            track.pattern = text_of(known, value);
        } else if (known == "name") {
            track.name = part_name(value);
        } else if (known == "section") {
            track.section = section_of(known, value);
        } else if (known == "variant") {
            track.variant_value = &value;
            track.overrides.variant = text_of(known, value);
        } else if (known == "set") {
            if (value.type != FileValue::Type::table) fail(value, "set: expected a table of keys and defines");
            for (const auto& [inner, one] : value.table) {
                refuse_whole(folded(inner), one);
                track.settings.push_back({{inner, inner, text_of(inner, one)}, &one});
            }
        } else if (known == "n" || known == "seed" || music_key(known)) {
            track.settings.push_back({part_setting(known, text_of(known, value)), &value});
        } else {
            refuse_key(value, key, Place::track);
        }
    }

    void read_track(const FileValue& value) {
        if (value.type != FileValue::Type::table) fail(value, "track: expected [[track]] tables");
        TrackKeys track;
        const std::size_t before = errors_.size();
        for (const auto& [key, one] : value.table) {
            collect([&, &key = key, &one = one] { read_key(key, one, track); });
        }
        const std::vector<PlacedSetting> own = track.settings;
        std::vector<PlacedSetting> settings = shared_;
        // The tempo of a section applies to the score, not to its tracks.
        if (const auto section = sections_.find(track.section); section != sections_.end()) {
            std::copy_if(section->second.settings.begin(), section->second.settings.end(),
                         std::back_inserter(settings),
                         [](const PlacedSetting& one) { return one.setting.key != "tempo"; });
        }
        settings.insert(settings.end(), track.settings.begin(), track.settings.end());
        track.settings = std::move(settings);
        if (track.pattern.empty() && errors_.size() > before) return;
        if (track.pattern.empty()) fail(value, "this track has no pattern");
        const NamedPattern& found = pattern(track.pattern, *track.pattern_value);
        Diagnostics diagnostics;
        Document document = Document::compile(found.name, found.text, track.overrides, diagnostics);
        if (!diagnostics.is_unreadable()) read_melody(document.pattern(), {}, diagnostics);
        const std::string variant = "variant " + track.overrides.variant;
        for (const Diagnostic& one : diagnostics.list()) {
            if (!track.overrides.variant.empty() && one.file == variant) {
                fail(*track.variant_value, fmt::format("{}: {}", variant, one.message));
            }
        }
        diagnostics.throw_if_errors();
        if (std::find(inner_.begin(), inner_.end(), track.pattern) != inner_.end()) note_replaced(document, track);
        const bool is_first = result_.tracks.empty() && !sections_.empty();
        const Meter stated = is_first ? meter_of(document) : Meter();
        for (const PlacedSetting& one : track.settings) {
            collect([&] { document = with(document, one); });
        }
        if (errors_.size() > before) return;
        if (is_first) first_meter_ = tempo_of(own).meter.value_or(stated);
        require_turtle(document, "it has no melody");
        Diagnostics unplayable;
        check_phrases(document.pattern(), document.grammar(), unplayable);
        if (unplayable.has_errors()) fail(value, unplayable.list().front().message);
        result_.tracks.push_back(
            {std::move(document), std::move(track.pattern), track.section, std::move(track.name)});
    }

    /// Records the keys of a pattern of this file that keys above the tracks replace.
    void note_replaced(const Document& document, const TrackKeys& track) {
        for (const PlacedSetting& one : shared_) {
            const std::string& key = one.setting.key;
            const Key* stated = document.pattern().find(key);
            if (!stated || stated->value.view() == one.setting.value) continue;
            // The track may set the key itself.
            const bool is_own =
                std::any_of(track.settings.begin() + static_cast<std::ptrdiff_t>(shared_.size()),
                            track.settings.end(), [&](const PlacedSetting& own) { return own.setting.key == key; });
            auto& keys = replaced_[track.pattern];
            if (!is_own && std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
        }
    }

    void add_remarks() {
        for (const auto& [pattern, keys] : replaced_) {
            if (keys.empty()) continue;
            result_.remarks.push_back(fmt::format(
                "'{}' states {} itself, but {}; to keep its own, state it in the tracks instead", printable(pattern),
                fmt::join(keys, ", "),
                keys.size() == 1 ? "the value above the tracks applies" : "the values above the tracks apply"));
        }
    }

    /// @throws FileError at the place of the setting
    static Document with(const Document& document, const PlacedSetting& one) {
        const auto refuse = [&](const std::string& message) {
            fail(*one.value, fmt::format("{}: {}", one.setting.origin == "-n" ? "n" : one.setting.key, message));
        };
        try {
            Document changed = document.with({one.setting});
            Diagnostics diagnostics;
            read_melody(changed.pattern(), {}, diagnostics);
            for (const Diagnostic& diagnostic : diagnostics.list()) {
                if (!diagnostic.warning) refuse(diagnostic.message);
            }
            return changed;
        } catch (const PatternError& error) {
            refuse(error.diagnostics().front().message);
        }
        return document;
    }

    /// True if a section is in the form of the piece.
    bool is_played(char letter) const {
        return std::any_of(result_.form.begin(), result_.form.end(),
                           [&](const FormSection& one) { return one.letter == letter - 'A'; });
    }

    void check_sections(const FileValue& tracks, const FileValue* form) const {
        for (std::size_t i = 0; i < result_.tracks.size(); ++i) {
            const char section = result_.tracks[i].section;
            if (section != 0 && !is_played(section)) {
                fail(tracks.list[i],
                     result_.form.empty()
                         ? fmt::format("section {} needs a form above the first track, such as form = \"A B A\"",
                                       section)
                         : fmt::format("section {} is not in the form of the piece", section));
            }
        }
        for (const auto& [letter, section] : sections_) {
            if (!is_played(letter))
                fail(*section.place, fmt::format("section {} is not in the form of the piece", letter));
        }
        for (const FormSection& one : result_.form) {
            const bool has_tracks =
                std::any_of(result_.tracks.begin(), result_.tracks.end(),
                            [&](const Track& track) { return track.section == static_cast<char>('A' + one.letter); });
            if (!has_tracks) fail(*form, fmt::format("no track has section {}", static_cast<char>('A' + one.letter)));
        }
    }

    /// Tempo and meter, as far as settings state them.
    static SectionTempo tempo_of(const std::vector<PlacedSetting>& settings) {
        static const Document plain = parse("plain", "axiom: F\n");
        SectionTempo stated;
        for (const PlacedSetting& one : settings) {
            const std::string& key = one.setting.key;
            if (key != "tempo" && key != "meter") continue;
            Diagnostics diagnostics;
            const Melody melody = read_melody(with(plain, one).pattern(), {}, diagnostics);
            if (key == "meter") {
                stated.meter = melody.meter;
            } else {
                stated.tempo = melody.tempo;
                stated.tempo_words = melody.tempo_words;
                stated.follows_curve = melody.expression.tempo.is_on();
            }
        }
        return stated;
    }

    static Meter meter_of(const Document& document) {
        Diagnostics diagnostics;
        return read_melody(document.pattern(), {}, diagnostics).meter;
    }

    /// Reads tempo and meter of the piece and its sections.
    void read_section_tempos() {
        const SectionTempo piece = tempo_of(shared_);
        result_.tempo = piece.tempo;
        result_.tempo_words = piece.tempo_words;
        result_.meter = piece.meter;
        // That of the first track, but not of its section.
        if (!result_.meter && !sections_.empty()) result_.meter = first_meter_;
        for (const auto& [letter, section] : sections_) {
            const SectionTempo stated = tempo_of(section.settings);
            const auto tempo = std::find_if(section.settings.begin(), section.settings.end(),
                                            [](const PlacedSetting& one) { return one.setting.key == "tempo"; });
            if (stated.follows_curve) {
                fail(*tempo->value, "tempo: only the tempo of the whole piece can follow a curve");
            }
            if (stated.tempo || stated.meter) result_.section_tempos.emplace(letter, stated);
        }
    }

    const std::string& file_;
    const std::string& text_;
    const PatternReader& read_;
    std::map<std::string, NamedPattern> known_;
    std::vector<std::string> inner_;
    std::map<std::string, std::vector<std::string>> replaced_;  ///< keys by pattern
    std::vector<PlacedSetting> shared_;
    std::map<char, Section> sections_;
    Meter first_meter_;
    std::vector<FileError> errors_;
    Arrangement result_;
};

}  // namespace

Setting part_setting(std::string_view key, std::string value) {
    std::string name = folded(key);
    if (name == "n" || name == "generations") name = "derivation length";
    // Names of defines keep their case.
    const bool is_known = find_language_key(name) != nullptr || name == "seed";
    return {name == "derivation length" ? "-n"
            : is_known                  ? name
                                        : std::string(key),
            is_known ? name : std::string(key), std::move(value)};
}

PatternReader beside_first(std::filesystem::path folder, PatternReader read) {
    return [folder = std::move(folder), read = std::move(read)](const std::string& pattern) {
        std::error_code error;
        const std::filesystem::path beside = folder / pattern;
        const bool is_beside = pattern != "-" && std::filesystem::exists(beside, error);
        return read(is_beside ? beside.string() : pattern);
    };
}

Arrangement read_arrangement(const std::string& file, const std::string& text, const PatternReader& read) {
    return ArrangementReader(file, text, read).read();
}

Arrangement arrangement_of(std::span<const Document> documents) {
    Arrangement result;
    std::map<std::string, std::string> texts;  // texts of patterns, by name
    std::string patterns;
    for (const Document& document : documents) {
        std::string name = document.source().name();
        const std::string& text = document.source().text();
        for (int copy = 2; texts.contains(name) && texts[name] != text; ++copy) {
            name = fmt::format("{} {}", document.source().name(), copy);
        }
        if (texts.emplace(name, text).second) patterns += pattern_table(name, text);
        result.text += fmt::format("{}[[track]]\npattern = {}\n", result.text.empty() ? "" : "\n", toml_string(name));
        const Overrides& overrides = document.overrides();
        if (!overrides.variant.empty()) result.text += fmt::format("variant = {}\n", toml_string(overrides.variant));
        std::map<std::string, std::string> own;   // the last value of a key counts
        std::map<std::string, std::string> more;  // keys of the curve, and defines
        std::string shared;
        for (const Setting& setting : overrides.settings) {
            const std::string key = setting.key;
            const bool is_head = key == "tempo" || key == "ending";
            const bool is_own = key == "derivation length" || key == "seed" || (music_key(key) && !is_head);
            if (is_head && !result.tracks.empty()) continue;  // the first pattern sets them
            if (is_head) {
                shared += fmt::format("{} = {}\n", key, toml_string(setting.value));
            } else {
                (is_own ? own : more)[key] = setting.value;
            }
        }
        for (const auto& [key, value] : own) {
            std::string written = key == "derivation length" ? "n" : key;
            std::replace(written.begin(), written.end(), ' ', '-');
            result.text += fmt::format("{} = {}\n", written, toml_string(value));
        }
        if (!more.empty()) {
            std::string list;
            for (const auto& [key, value] : more) {
                list += fmt::format("{}{} = {}", list.empty() ? "" : ", ", toml_string(key), toml_string(value));
            }
            result.text += fmt::format("set = {{ {} }}\n", list);
        }
        result.text = shared + (shared.empty() ? "" : "\n") + result.text;
        result.tracks.push_back({document, name, 0, {}});
    }
    result.text += patterns;
    return result;
}

}  // namespace sikku
