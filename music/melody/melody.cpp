#include "music/melody/melody.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "music/melody/key_values.h"
#include "music/score/instruments.h"
#include "music/score/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace sikku {
namespace {

constexpr double most_tempo = 1000;
constexpr std::int64_t most_unit = 64 * 4 * ticks_per_quarter;

/// Spelling of the nearest key, with at most one accidental.
Spelling usual_spelling(double key) {
    static constexpr std::array<Spelling, 12> usual = {
        {{0, 0}, {1, -1}, {1, 0}, {2, -1}, {2, 0}, {3, 0}, {3, 1}, {4, 0}, {5, -1}, {5, 0}, {6, -1}, {6, 0}}};
    const auto whole = static_cast<long>(std::lround(std::clamp(key, -1e3, 1e3)));
    return usual[static_cast<std::size_t>((whole % 12 + 12) % 12)];
}

/// A choice among words; several words may mean the same.
template <class Choice>
using Choices = std::vector<std::pair<std::string_view, Choice>>;

class MelodyReader : private KeyReader {
public:
    MelodyReader(const Pattern& pattern, const FileReader& read_file, Diagnostics& diagnostics)
        : KeyReader(pattern, diagnostics), read_file_(read_file) {}

    Melody read() {
        read_scale();
        read_tonic();
        choose<Mapping>(
            "mapping", melody_.mapping,
            {{"runs", Mapping::runs}, {"counterpoint", Mapping::counterpoint}, {"symbols", Mapping::symbols}});
        choose<Branches>(
            "brackets", melody_.branches,
            {{"voices", Branches::voices}, {"sequence", Branches::sequence}, {"shares", Branches::shares}});
        choose<Anchor>("anchor", melody_.anchor,
                       {{"first note", Anchor::first_note},
                        {"piece", Anchor::piece},
                        {"lowest note", Anchor::lowest_note},
                        {"lowest vertex", Anchor::lowest_vertex},
                        {"centre", Anchor::centre},
                        {"center", Anchor::centre}});
        choose<Vertical>("vertical", melody_.vertical,
                         {{"ignore", Vertical::ignore},
                          {"rest", Vertical::rest},
                          {"extend", Vertical::extend},
                          {"glissando", Vertical::glissando},
                          {"voice", Vertical::voice}});
        choose<Runs>("runs", melody_.runs, {{"merged", Runs::merged}, {"each step", Runs::each_step}});
        choose<Sloped>("sloped", melody_.sloped,
                       {{"project", Sloped::project}, {"skip", Sloped::skip}, {"refuse", Sloped::refuse}});
        read_range();
        const Key* velocity = pattern_.find("velocity");
        if (!velocity || !states_curve(velocity->value.view()))
            choose<Loudness>("velocity", melody_.loudness,
                             {{"fixed", Loudness::fixed},
                              {"by turn", Loudness::by_turn},
                              {"by depth", Loudness::by_depth},
                              {"by length", Loudness::by_length}},
                             ", or by x, y, depth, turn, length or level with velocities such as by y 50-110; "
                             "`by x 80-80` sets velocity 80");
        read_unit();
        read_symbol_table(pattern_, melody_, diagnostics_);
        read_rhythm();
        read_form();
        read_harmony();
        read_tempo();
        read_expression(pattern_, melody_, diagnostics_);
        read_meter();
        read_instrument();
        read_accompaniment();
        read_place();
        warn_of_what_has_no_meaning();
        return std::move(melody_);
    }

private:
    template <class Choice>
    void choose(std::string_view name, Choice& chosen, const Choices<Choice>& choices, std::string_view remark = {}) {
        const Key* key = pattern_.find(name);
        if (key) choose(name, key->value.view(), chosen, choices, remark);
    }

    /// @param remark  other values that are expected
    template <class Choice>
    void choose(std::string_view name, std::string_view text, Choice& chosen, const Choices<Choice>& choices,
                std::string_view remark = {}) {
        const Key* key = pattern_.find(name);
        std::string wanted = lower_case(text);
        std::replace(wanted.begin(), wanted.end(), '-', ' ');
        std::vector<std::string_view> words;
        for (const auto& [word, choice] : choices) {
            if (word == wanted) {
                chosen = choice;
                return;
            }
            if (word != "center" && word != "true" && word != "false") words.push_back(word);
        }
        fail(*key, fmt::format("expected {}{}{}", alternatives(words), remark, did_you_mean(nearest(wanted, words))));
    }

    void warn_of_what_has_no_meaning() {
        if (melody_.mapping == Mapping::symbols && !melody_.table.empty() && melody_.anchor == Anchor::piece) {
            diagnostics_.warning(pattern_.find("anchor")->name_at,
                                 "'anchor: piece' has no meaning where symbols name notes, as degree 0 is the tonic");
        }
        if (melody_.mapping == Mapping::runs) return;
        for (const std::string_view name : {"vertical", "runs", "sloped", "brackets"}) {
            const bool is_read = melody_.mapping == Mapping::symbols && (name == "runs" || name == "brackets");
            if (const Key* key = pattern_.find(name); key && !is_read) {
                diagnostics_.warning(key->name_at, fmt::format("'{}:' has no meaning with this 'mapping:'", name));
            }
        }
    }

    void read_scale() {
        melody_.scale = *find_scale("major");
        if (const Key* key = pattern_.find("scale")) {
            const std::string name(key->value.view());
            if (lower_case(name).ends_with(".scl")) {
                if (const auto text = file_text(*key)) {
                    const Source source(name, *text);
                    // Errors are reported while `source` exists.
                    if (auto scale = read_scl(source, diagnostics_)) melody_.scale = std::move(*scale);
                }
            } else if (const Scale* known = find_scale(name)) {
                melody_.scale = *known;
            } else {
                fail(*key, unknown_scale(name));
            }
        }
        if (const Key* key = pattern_.find("keyboard")) {
            if (const auto text = file_text(*key)) {
                const Source source(std::string(key->value.view()), *text);
                melody_.keys = read_kbm(source, diagnostics_);
            }
        }
    }

    std::optional<std::string> file_text(const Key& key) {
        if (!read_file_) return std::nullopt;
        try {
            return read_file_(std::string(key.value.view()));
        } catch (const std::runtime_error& error) {
            diagnostics_.error(key.value, error.what());
            return std::nullopt;
        }
    }

    void read_tonic() {
        const Key* key = pattern_.find("tonic");
        if (!key) return;
        std::string text(key->value.view());
        if (const auto note = parse_note(text)) {
            melody_.tonic_spelling = note->spelling;
            melody_.tonic = note->key;
        } else {
            const bool has_unit = lower_case(text).ends_with("hz");
            if (has_unit) text.resize(text.size() - 2);
            while (text.ends_with(' ')) text.pop_back();
            double frequency = 0;
            if (!read_number(text, frequency) || !(frequency > 0)) {
                return fail(*key, "expected a note such as C4, F#3 or Bb, or a frequency such as 261.63 Hz");
            }
            if (!has_unit && frequency <= 127 && frequency == std::floor(frequency)) {
                diagnostics_.error(key->value,
                                   fmt::format("a number alone may be a key or a frequency; expected {} "
                                               "for key {} of MIDI, or {} Hz",
                                               note_name(frequency, spell(melody_.scale, {})), text, text));
                return;
            }
            melody_.tonic = 69 + 12 * std::log2(frequency / 440.0);
            melody_.tonic_spelling = usual_spelling(melody_.tonic);
        }
        if (!(melody_.tonic >= 0 && melody_.tonic <= 127)) {
            diagnostics_.error(key->value, "the tonic lies beyond what MIDI can write: C-1 to G9, 8.2 to 12543.8 Hz");
        }
    }

    /// Reads `3/4` or `2` as two whole numbers; false for anything else.
    bool fraction(const Key& key, std::int64_t& above, std::int64_t& below) const {
        const std::string_view text = key.value.view();
        const std::size_t slash = text.find('/');
        constexpr std::int64_t most = 100'000;
        const auto first = whole_number(text.substr(0, slash), 0, most);
        const auto second = slash == std::string_view::npos ? 1 : whole_number(text.substr(slash + 1), 0, most);
        above = first.value_or(0);
        below = second.value_or(0);
        return first && second;
    }

    /// Reads `fold` or `fold C2-C7`.
    void read_range() {
        const Key* key = pattern_.find("range");
        if (!key) return;
        const std::string_view text = key->value.view();
        const std::size_t blank = text.find(' ');
        choose<Range>(
            "range", text.substr(0, blank), melody_.range,
            {{"fold", Range::fold}, {"reflect", Range::reflect}, {"clamp", Range::clamp}, {"refuse", Range::refuse}},
            ", perhaps with the lowest and the highest note, such as `fold C2-C7`");
        if (blank == std::string_view::npos) return;
        const std::string_view keys = text.substr(text.find_first_not_of(' ', blank));
        // A dash may belong to an octave: C-1-C7.
        for (std::size_t dash = keys.find('-'); dash != std::string_view::npos; dash = keys.find('-', dash + 1)) {
            const auto low = parse_note(keys.substr(0, dash));
            const auto high = parse_note(keys.substr(dash + 1));
            if (!low || !high || low->key < 0 || high->key > 127 || low->key > high->key) continue;
            melody_.lowest = low->key;
            melody_.highest = high->key;
            return;
        }
        diagnostics_.error(key->value, "expected the lowest and the highest note, such as `fold C2-C7`");
    }

    void read_unit() {
        const Key* key = pattern_.find("unit");
        if (!key) return;
        std::int64_t above = 0;
        std::int64_t below = 1;
        const bool good = fraction(*key, above, below) && above > 0 && below > 0;
        const std::int64_t whole_note = 4 * ticks_per_quarter;
        if (good && above * whole_note % below != 0) {
            diagnostics_.error(
                key->value,
                fmt::format("{}/{} is not a whole number of ticks, of which a whole note has {}; "
                            "expected a divisor such as 4, 6, 8, 10, 12, 16, 20, 24, 32 or 64{}",
                            above, below, whole_note, below % 7 == 0 ? "; for septuplets use `speed: 7:4`" : ""));
            return;
        }
        if (!good || above * whole_note / below > 16 * whole_note) {
            return fail(*key, "expected a note value such as 1/16, 1/8 or 3/16, up to 16 whole notes");
        }
        if (below == 1 && above > 1) {
            diagnostics_.warning(key->value,
                                 fmt::format("a step lasts {} whole notes; did you mean 1/{}?", above, above));
        }
        melody_.unit = above * whole_note / below;
    }

    /// Removes ` by level` from the end of a text; false if it does not end so.
    static bool take_by_level(std::string_view& text) {
        constexpr std::string_view words = " by level";
        if (!lower_case(text).ends_with(words)) return false;
        text = trimmed(text.substr(0, text.size() - words.size()));
        return true;
    }

    /// Reads a rhythm, or several, separated by `/`.
    void read_rhythms(const Key& key) {
        std::string problem;
        std::string_view rest = key.value.view();
        melody_.has_rhythms_by_level = take_by_level(rest);
        for (;;) {
            const std::size_t end = std::min(rest.find('/'), rest.size());
            melody_.rhythms.push_back(read_rhythm_template(trimmed(rest.substr(0, end)), problem));
            if (melody_.rhythms.back().empty()) {
                melody_.rhythms.clear();
                return fail(key, problem);
            }
            if (end == rest.size()) break;
            rest.remove_prefix(end + 1);
        }
        melody_.rhythm = melody_.rhythms.front();
        if (melody_.rhythms.size() > 1) return;
        melody_.rhythms.clear();
        if (melody_.has_rhythms_by_level) fail(key, "expected several rhythms: `x.x. / X..x by level`");
    }

    void read_rhythm() {
        if (const Key* key = pattern_.find("rhythm"); key && lower_case(key->value.view()) != "curve") {
            read_rhythms(*key);
            if (melody_.branches == Branches::shares) {
                fail(*key, "'rhythm:' cannot be combined with `brackets: shares`");
            }
        }
        read_key("swing",
                 "expected the share of the first of two eighths in percent, from 50 to 80, such as `67`; of two "
                 "sixteenths `60 1/16`",
                 [&](std::string_view text) {
                     const std::size_t blank = std::min(text.find(' '), text.size());
                     std::string_view percent = text.substr(0, blank);
                     if (percent.ends_with('%')) percent.remove_suffix(1);
                     double share = 0;
                     const auto unit = blank < text.size() ? note_value(text.substr(blank + 1)) : melody_.swing_unit;
                     if (!read_number(percent, share) || !(share >= 50 && share <= 80) || !unit || *unit == 0) {
                         return false;
                     }
                     melody_.swing = share / 100;
                     melody_.swing_unit = *unit;
                     return true;
                 });
    }

    void read_form() {
        if (const Key* key = pattern_.find("phrases"); key && lower_case(key->value.view()) != "none") {
            std::string_view text = key->value.view();
            if (text.starts_with("order ")) text.remove_prefix(6);
            melody_.phrase_order = whole_number(text, 1).value_or(0);
            if (melody_.phrase_order == 0) {
                fail(*key, "expected the order of the sub-curves that are phrases, 1 or more, or none");
            } else {
                melody_.breath = ticks_per_quarter / 2;
            }
        }
        if (const Key* key = pattern_.find("breath")) read_breath(*key);
        choose<Cadence>("cadence", melody_.cadence,
                        {{"none", Cadence::none}, {"tonic", Cadence::tonic}, {"alternate", Cadence::alternate}});
        const Key* rhythm = pattern_.find("rhythm");
        if (rhythm && !melody_.rhythms.empty() && melody_.phrase_order == 0) {
            fail(*rhythm, "several rhythms need `phrases: k`, as each phrase takes one");
        }
        read_leaps();
        read_articulation();
        choose<Close>("ending", melody_.close,
                      {{"none", Close::none}, {"ritardando", Close::ritardando}, {"fermata", Close::fermata}});
    }

    /// Notes move by whole periods, so that the smallest limit is half a period.
    void read_leaps() {
        const Key* key = pattern_.find("leaps");
        if (!key || lower_case(key->value.view()) == "none") return;
        constexpr int widest = 127;
        const auto least = static_cast<int>(std::ceil(std::fabs(melody_.scale.period) / 200));
        const auto semitones = whole_number(key->value.view(), least, widest);
        if (!semitones) {
            return fail(*key, fmt::format("expected the largest leap in semitones, from {} (half a period of the "
                                          "scale, by which notes move) to {}, or none",
                                          least, widest));
        }
        melody_.leaps = static_cast<int>(*semitones);
    }

    /// Reads `1/8`, `bar` for a rest until the next bar line, or `1/8 bar` for one of at least an eighth.
    void read_breath(const Key& key) {
        std::string_view text = key.value.view();
        const bool is_by_level = take_by_level(text);
        const bool is_to_bar = text == "bar" || text.ends_with(" bar");
        if (is_to_bar) text = trimmed(text.substr(0, text.size() - 3));
        const bool is_none = text == "none" || (is_to_bar && text.empty());
        const auto ticks = is_none ? std::optional<std::int64_t>(0) : note_value(text);
        if (!ticks) {
            fail(key, "expected a note value such as 1/8, up to 16 whole notes, bar, 1/8 bar, 1/8 by level or none");
        } else if (melody_.phrase_order == 0) {
            diagnostics_.warning(key.name_at, "'breath:' has no effect without 'phrases:'");
        } else if (is_by_level && *ticks == 0) {
            fail(key, "a rest that grows with the level has a note value: `1/8 by level`");
        } else {
            melody_.breath = *ticks;
            melody_.breathes_to_bar = is_to_bar;
            melody_.breathes_by_level = is_by_level;
        }
    }

    /// Checks what changes the pitch of sections and phrases.
    void check_changed_sections() {
        const Layout& layout = melody_.layout;
        const bool moves = std::any_of(layout.form.begin(), layout.form.end(),
                                       [](const FormSection& section) { return section.has_other_degrees(); });
        if (moves && melody_.has_chords()) {
            fail(*pattern_.find("form"), "sections with chords cannot be moved or inverted: the chords would stay");
        } else if (moves && melody_.vertical == Vertical::glissando) {
            fail(*pattern_.find("form"), "sections with `vertical: glissando` cannot be moved or inverted");
        }
        for (const FormSection& section : layout.form) {
            if (melody_.unit % section.augmentation.below == 0) continue;
            fail(*pattern_.find("form"), "the notes would be no whole numbers of ticks; a larger `unit` helps");
            break;
        }
        const bool has_korvai = std::any_of(layout.form.begin(), layout.form.end(),
                                            [](const FormSection& section) { return section.is_korvai; });
        if (has_korvai && melody_.harmony == Harmony::bass) {
            fail(*pattern_.find("form"), "a korvai cannot be combined with `harmony: bass`, whose notes are longer");
        }
        if (layout.thinning > 0) {
            const Key& thinning = *pattern_.find("thinning");
            if (melody_.vertical == Vertical::glissando) {
                fail(thinning,
                     "'thinning:' cannot be combined with `vertical: glissando`: slides would lose their target "
                     "notes");
            } else if (melody_.phrase_order == 0 && layout.form.empty()) {
                fail(thinning, "'thinning:' needs 'phrases:' or 'form:'");
            }
        }
        if (!layout.climax) return;
        const Key& climax = *pattern_.find("climax");
        if (melody_.has_chords()) {
            fail(climax, "phrases with chords cannot be moved: the chords would stay");
        } else if (melody_.vertical == Vertical::glissando) {
            fail(climax, "phrases with `vertical: glissando` cannot be moved");
        } else if (melody_.phrase_order == 0 && layout.form.empty()) {
            fail(climax, "'climax:' needs 'phrases:' or 'form:', as it moves phrases or sections");
        }
    }

    /// Sets the order of the sub-curves of a form, which are marked like phrases.
    void read_sections() {
        check_changed_sections();
        Layout& layout = melody_.layout;
        const Key* key = pattern_.find("form");
        if (layout.form.empty() || !key) return;
        if (melody_.phrase_order > 0 && layout.form_order > 0 && layout.form_order != melody_.phrase_order) {
            fail(*key, fmt::format("the orders must agree: 'phrases:' has {} and the form {}; expected "
                                   "`phrases: {}`, or a form without an order",
                                   melody_.phrase_order, layout.form_order, layout.form_order));
        }
        layout.is_order_of_phrases = melody_.phrase_order > 0;
        if (layout.form_order > 0) melody_.phrase_order = layout.form_order;
        if (layout.form_order == 0) layout.form_order = melody_.phrase_order;
    }

    /// Reads `drone`, `triads`, `bass`, `bass 3` or `progression I-IV-V-I`.
    void read_harmony() {
        const Key* key = pattern_.find("harmony");
        if (!key) return;
        const std::string_view text = key->value.view();
        const std::size_t blank = std::min(text.find(' '), text.size());
        const std::string kind = lower_case(text.substr(0, blank));
        const std::string_view rest = text.substr(std::min(text.find_first_not_of(' ', blank), text.size()));
        if (kind == "progression") {
            std::string problem;
            melody_.harmony = Harmony::progression;
            melody_.progression = read_progression(rest, melody_.scale, melody_.tonic, problem);
            if (melody_.progression.empty()) fail(*key, problem);
        } else if (kind == "bass" && !rest.empty()) {
            melody_.harmony = Harmony::bass;
            const auto order = whole_number(rest, 1, 30);
            if (!order) {
                fail(*key, "expected the orders by which the bass is coarser, from 1 to 30");
            }
            melody_.bass_order = order.value_or(1);
        } else {
            choose<Harmony>("harmony", text, melody_.harmony,
                            {{"none", Harmony::none},
                             {"drone", Harmony::drone},
                             {"triads", Harmony::triads},
                             {"bass", Harmony::bass},
                             {"progression I-IV-V-I", Harmony::progression}},
                            "; `bass 2` is two orders coarser than the melody");
        }
        if (melody_.keys && melody_.harmony != Harmony::none) {
            fail(*key, "'harmony:' cannot be combined with 'keyboard:'");
        }
    }

    /// Reads the keys that distinguish a part from others that play the same curve.
    void read_place() {
        choose<bool>("inversion", melody_.is_inverted,
                     {{"no", false}, {"yes", true}, {"false", false}, {"true", true}});
        read_key("transposition", "expected semitones from -127 to 127", [&](std::string_view text) {
            double semitones = 0;
            const bool is_good = read_number(text, semitones) && std::fabs(semitones) <= 127;
            if (is_good) transpose(melody_, semitones);
            return is_good;
        });
        melody_.layout = read_layout(pattern_, diagnostics_);
        read_upbeat();
        augment();
        read_sections();
    }

    void read_upbeat() {
        const Key* key = pattern_.find("upbeat");
        if (!key || lower_case(key->value.view()) == "none") return;
        constexpr std::int64_t finest = ticks_per_quarter / 16;
        const std::int64_t whole_note = 4 * ticks_per_quarter;
        std::int64_t above = 0;
        std::int64_t below = 1;
        const bool is_good = fraction(*key, above, below) && above > 0 && below > 0 && above <= 64 * below &&
                             above * whole_note % (below * finest) == 0;
        const std::int64_t ticks = is_good ? above * whole_note / below : 0;
        if (!is_good || ticks >= melody_.meter.bar()) {
            return fail(*key, "expected a note value shorter than a bar, in 64ths, such as 1/8, 1/4 or 3/8, or none");
        }
        // MIDI writes the upbeat as a bar.
        if (ticks / std::gcd(ticks, whole_note) > 255) return fail(*key, "the numerator must be at most 255");
        if (!melody_.layout.tempo.is_one()) return fail(*key, "'upbeat:' cannot be combined with 'speed:'");
        if (melody_.layout.is_retrograde) return fail(*key, "'upbeat:' cannot be combined with 'retrograde:'");
        melody_.layout.upbeat = ticks;
    }

    /// Multiplies the unit and the breath by the augmentation.
    void augment() {
        const Ratio by = melody_.layout.augmentation;
        if (by.is_one()) return;
        const Key& key = *pattern_.find("augmentation");
        for (std::int64_t* ticks : {&melody_.unit, &melody_.breath}) {
            if (*ticks * by.above % by.below != 0) {
                return fail(key, "the notes would be no whole numbers of ticks; a larger `unit` helps");
            }
            *ticks = *ticks * by.above / by.below;
        }
        if (melody_.unit > most_unit) fail(key, "a step would last more than 64 whole notes");
    }

    void read_articulation() {
        const Key* key = pattern_.find("articulation");
        if (!key) return;
        std::string_view text = key->value.view();
        double percent = 0;
        if (text.ends_with('%')) text.remove_suffix(1);
        if (read_number(text, percent)) {
            if (!(percent >= 5 && percent <= 100)) {
                diagnostics_.error(key->value, "expected a share of the note from 5 to 100 percent");
                return;
            }
            melody_.articulation = percent < 100 ? Articulation::detached : Articulation::legato;
            melody_.sounding = percent / 100;
            return;
        }
        choose<Articulation>("articulation", melody_.articulation,
                             {{"legato", Articulation::legato},
                              {"detached", Articulation::detached},
                              {"by depth", Articulation::by_depth}},
                             ", or the share of each note that sounds, from 5 to 100 percent, such as 60%");
    }

    void read_tempo() {
        read_key("tempo",
                 "expected quarter notes a minute, from 4 to 1000: `96`, `96 Andante` (up to 60 letters without "
                 "digits and quotation marks), or a word such as `Andante`",
                 [&](std::string_view text) {
                     // A curve, or words, follow after a blank.
                     const std::size_t end = std::min(text.find(' '), text.size());
                     double tempo = 0;
                     if (!read_number(text.substr(0, end), tempo)) return read_tempo_word(text);
                     if (!(tempo >= 4 && tempo <= most_tempo)) return false;
                     melody_.tempo = tempo;
                     return states_curve(text) || read_tempo_words(trimmed(text.substr(end)));
                 });
    }

    /// Reads a word that states a tempo.
    bool read_tempo_word(std::string_view text) {
        struct TempoWord {
            std::string_view word;
            double tempo;
        };
        static constexpr std::array<TempoWord, 13> words = {{{"grave", 40},
                                                             {"largo", 50},
                                                             {"larghetto", 63},
                                                             {"lento", 54},
                                                             {"adagio", 69},
                                                             {"andante", 84},
                                                             {"andantino", 92},
                                                             {"moderato", 104},
                                                             {"allegretto", 116},
                                                             {"allegro", 138},
                                                             {"vivace", 160},
                                                             {"presto", 184},
                                                             {"prestissimo", 208}}};
        const std::string first = lower_case(text.substr(0, text.find(' ')));
        const auto* found =
            std::find_if(words.begin(), words.end(), [&](const TempoWord& one) { return one.word == first; });
        if (found == words.end() || states_curve(text)) return false;
        melody_.tempo = found->tempo;
        return read_tempo_words(text);
    }

    /// Reads words that are printed above the first bar.
    bool read_tempo_words(std::string_view text) {
        constexpr std::size_t longest = 60;
        const bool is_good = text.size() <= longest && text.find_first_of("\"0123456789") == std::string_view::npos &&
                             printable(text) == text;
        if (is_good) melody_.tempo_words = text;
        return is_good;
    }

    /// Reads `4/4`, `7/8`, or with groups `3+2+2/8`.
    void read_meter() {
        read_key("meter",
                 "expected a meter such as 4/4, 7/8 or 3+2+2/8: 1 to 64, in up to 16 groups, over a power of two up "
                 "to 64",
                 [&](std::string_view text) {
                     const auto meter = parse_meter(text);
                     melody_.meter = meter.value_or(melody_.meter);
                     return meter.has_value();
                 });
    }

    void read_instrument() {
        const Key* key = pattern_.find("instrument");
        if (key) read_program(*key, key->value.view(), melody_.program);
    }

    /// Reads `oom-pah` or `bossa on guitar`.
    void read_accompaniment() {
        const Key* key = pattern_.find("accompaniment");
        if (!key) return;
        std::string_view text = key->value.view();
        const std::size_t on = lower_case(text).rfind(" on ");
        if (on != std::string::npos) {
            read_program(*key, trimmed(text.substr(on + 4)), melody_.accompanist.emplace(0));
            text = trimmed(text.substr(0, on));
        }
        std::string problem;
        melody_.figure = read_figure(text, melody_.meter, problem);
        if (!problem.empty()) return fail(*key, problem);
        if (!melody_.has_chords()) {
            diagnostics_.warning(key->name_at,
                                 "'accompaniment:' has no effect without `harmony: triads` or a progression");
        }
    }

    /// Reads the name or the number of an instrument.
    void read_program(const Key& key, std::string_view text, int& program) {
        if (const auto number = whole_number(text, INT_MIN, INT_MAX)) {
            if (*number < 1 || *number > 128) {
                diagnostics_.error(key.value, "the programs of General MIDI are 1 to 128");
            } else {
                program = static_cast<int>(*number) - 1;
            }
            return;
        }
        const std::string wanted = lower_case(text);
        std::vector<std::string> folded;
        for (const std::string_view name : instrument_names()) folded.push_back(lower_case(name));
        if (const auto same = std::find(folded.begin(), folded.end(), wanted); same != folded.end()) {
            program = static_cast<int>(same - folded.begin());
            return;
        }
        if (wanted == "piano") return;  // the first of all, and the default
        // Part of a name is enough: `guitar`, `strings`.
        if (wanted.size() >= 3 && choose_by_word(key, text, folded, program)) return;
        // The nearest name, or the one with the nearest word.
        std::string_view near = nearest(wanted, {folded.begin(), folded.end()});
        for (std::size_t i = 0; i < folded.size() && near.empty(); ++i) {
            for (const std::string_view word : split_words(folded[i])) {
                if (!nearest(wanted, {word}).empty()) near = folded[i];
            }
        }
        const std::string problem = text.empty() ? "" : fmt::format("unknown instrument '{}'; ", text);
        fail(key, near.empty() || text.empty()
                      ? problem + "expected a General MIDI name such as flute or sitar, or a number from 1 to 128"
                      : fmt::format("{}did you mean '{}'?", problem, near));
    }

    /// Selects the first name that contains the text, preferably as a whole word, and reports it. Three letters have
    /// to begin a word.
    bool choose_by_word(const Key& key, std::string_view text, const std::vector<std::string>& names, int& chosen) {
        const std::string wanted = lower_case(text);
        enum class How { word, part, all_words };
        for (const How how : {How::word, How::part, How::all_words}) {
            const bool is_word = how == How::word;
            const auto matches = [&](const std::string& name) {
                std::string padded = ' ' + name + ' ';
                if (how == How::all_words) {
                    for (char& letter : padded) letter = letter == '(' || letter == ')' ? ' ' : letter;
                    const std::vector<std::string_view> words = split_words(wanted);
                    return std::all_of(words.begin(), words.end(), [&](std::string_view word) {
                        return padded.find(fmt::format(" {} ", word)) != std::string::npos;
                    });
                }
                const std::string part = (is_word || wanted.size() == 3 ? " " : "") + wanted + (is_word ? " " : "");
                return padded.find(part) != std::string::npos;
            };
            const auto first = std::find_if(names.begin(), names.end(), matches);
            if (first == names.end()) continue;
            const auto program = static_cast<std::size_t>(first - names.begin());
            const auto others = std::count_if(names.begin(), names.end(), matches);
            chosen = static_cast<int>(program);
            diagnostics_.warning(
                key.value,
                fmt::format("instrument '{}' is taken to be {} ({}){}", text, instrument_names()[program],
                            program + 1, others > 1 ? fmt::format(", the first of {} with this word", others) : ""));
            return true;
        }
        return false;
    }

    const FileReader& read_file_;
    Melody melody_;
};

}  // namespace

void transpose(Melody& melody, double semitones) {
    melody.transpose += semitones;
    if (semitones != 0 && semitones == std::round(semitones)) {
        melody.tonic_spelling = usual_spelling(melody.tonic + semitones);
    }
}

std::optional<double> Melody::key(std::int64_t degree, bool falling) const {
    if (keys) {
        const std::int64_t place = keys->middle + degree;
        if (place < 0 || place > 127) return std::nullopt;
        const auto mapped = mapped_key(scale, *keys, static_cast<int>(place));
        if (!mapped) return std::nullopt;
        return *mapped + transpose;
    }
    return tonic + scale.cents(degree, falling) / 100 + transpose;
}

bool Melody::is_microtonal() const {
    constexpr double least = 0.005;  // half a cent
    const auto is_between = [](double semitones) { return std::fabs(semitones - std::round(semitones)) > least; };
    const auto any = [&](const std::vector<double>& cents) {
        return std::any_of(cents.begin(), cents.end(), [&](double one) { return is_between(one / 100); });
    };
    return keys || is_between(tonic) || is_between(transpose) || is_between(scale.period / 100) ||
           any(scale.ascent) || any(scale.descent);
}

Melody read_melody(const Pattern& pattern, const FileReader& read_file, Diagnostics& diagnostics) {
    return MelodyReader(pattern, read_file, diagnostics).read();
}

const std::vector<std::string_view>& instrument_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> list;
        for (int program = 0; program < 128; ++program) list.push_back(instrument_of(program).name);
        return list;
    }();
    return names;
}

}  // namespace sikku
