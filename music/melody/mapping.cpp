#include "music/melody/mapping.h"

#include "engine/derivation/forecast.h"
#include "engine/geometry/lattice.h"
#include "music/melody/emitter.h"
#include "music/melody/melody_fold.h"
#include "music/melody/reader.h"
#include "music/melody/symbol_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace sikku {
namespace {

using namespace mapping;

/// Skips the part of the word before the piece.
class Seeker final : public Pruner {
public:
    Seeker(const Grammar& grammar, const MelodyFold& fold, Reader& reader)
        : grammar_(grammar), fold_(fold), reader_(reader) {}
    bool passes_over(Symbol symbol, std::int64_t level) override {
        if (grammar_.is_push(symbol) || grammar_.is_pop(symbol)) return false;
        const GridStretch* stretch = fold_.stretch(symbol, level);
        if (stretch && reader_.skip(*stretch)) return true;
        // Short stretches are walked, as the piece is near.
        if (level == 0 || (stretch && stretch->length[0] + stretch->length[1] < 4096)) active = false;
        return false;
    }

private:
    const Grammar& grammar_;
    const MelodyFold& fold_;
    Reader& reader_;
};

/// The fold with which a reader of this melody skips parts of the word; nullopt if it has to walk.
std::optional<MelodyFold> fold_of(const Grammar& grammar, const Melody& melody, std::optional<Symbol> phrase) {
    if (melody.mapping == Mapping::symbols && !melody.table.empty()) return std::nullopt;
    const bool is_sequence = melody.branches == Branches::sequence || melody.mapping == Mapping::counterpoint;
    return MelodyFold::make(grammar, melody.mapping == Mapping::symbols ? FoldOf::symbols : FoldOf::curve,
                            is_sequence, phrase);
}

constexpr const char* phrases_of_voices =
    "phrases, forms and cadences follow one another, but branches that are voices sound at once; "
    "`brackets: sequence` plays branches one after another";

std::string unmarkable(bool has_sections) {
    return fmt::format("{} need a system without contexts, parameters and chance",
                       has_sections ? "phrases" : "levels");
}

bool has_sections(const Melody& melody) {
    return melody.phrase_order > 0 || !melody.layout.form.empty();
}

bool has_phrases(const Melody& melody) {
    return has_sections(melody) || melody.cadence != Cadence::none;
}

/// Order of the sub-curves that are phrases or sections; 0 if there are none.
std::int64_t order_of_phrases(const Melody& melody, std::int64_t steps) {
    // The sections of a form are by default the largest sub-curves.
    const bool is_default = melody.phrase_order == 0 && !melody.layout.form.empty();
    return is_default ? std::max<std::int64_t>(1, steps - 1) : melody.phrase_order;
}

struct Marked {
    Grammar grammar;
    Marks marks;
};

/// The grammar with the ends of phrases marked, and those of all sub-curves if the melody follows their levels.
/// @throws ScoreError
Marked marked(Grammar grammar, const Melody& melody) {
    constexpr std::int64_t most_levels = 64;
    const std::int64_t steps = grammar.steps();
    const std::int64_t levels = melody.follows_levels() ? std::min(steps, most_levels) : 0;
    const std::int64_t order = order_of_phrases(melody, steps);
    Marked result{std::move(grammar), {}};
    if (order == 0 && levels == 0) return result;
    std::vector<char> sounding;
    for (const SymbolEntry& entry : entries_of(result.grammar, melody)) {
        sounding.push_back(entry.has_row && entry.row.is_sounding() ? 1 : 0);
    }
    const auto add = [&](std::int64_t one) {
        // Each marked order adds a step.
        auto other = result.grammar.with_marks(one + std::min(one - 1, levels), sounding);
        if (!other) {
            throw ScoreError(unmarkable(order > 0));
        }
        result.grammar = *std::move(other);
        return *result.grammar.mark();
    };
    result.marks.whole = static_cast<std::uint8_t>(levels);
    for (std::int64_t level = 1; level <= levels; ++level) {
        const Symbol mark = add(level);
        result.marks.levels.resize(mark + std::size_t{1});
        result.marks.levels[mark] = static_cast<std::uint8_t>(level);
    }
    if (order > 0 && order <= steps) result.marks.phrase = add(order);
    return result;
}

/// Prepares the data that readers need once, and runs them.
class Player {
public:
    /// @param plain  the grammar without marks
    Player(const Grammar& grammar, const Grammar& plain, const Melody& melody, const Marks& marks,
           const PlayOptions& options)
        : grammar_(grammar),
          plain_(plain),
          melody_(melody),
          marks_(marks),
          options_(options),
          lattice_(make_lattice(grammar)) {
        is_grid_ = is_on_grid(lattice_, first_);
        const bool has_branches = has_brackets(grammar);
        has_voices_ = has_branches && melody.branches == Branches::voices;
        if (has_voices_ && has_phrases(melody)) {
            throw ScoreError(phrases_of_voices);
        }
        shares_ = has_branches && melody.branches == Branches::shares && melody.mapping != Mapping::counterpoint;
        const bool has_anchor = melody.anchor != Anchor::first_note && melody.anchor != Anchor::piece;
        const bool is_anchored = melody.mapping == Mapping::runs && has_anchor;
        if (options.from > 0 || is_anchored) fold_ = fold_of(grammar, melody, marks.phrase);
        if (options.ahead > 0 && (!fold_ || has_voices_ || melody.mapping != Mapping::runs ||
                                  melody.vertical == Vertical::voice || melody.is_sequential())) {
            throw ScoreError(
                "bars beyond 2^60 ticks need `mapping: runs` of a curve on the square grid, without voices, without "
                "phrases that begin at bar lines or with rhythms of their own, without breaths by level, and without "
                "`leaps`");
        }
    }

    PlayReport play(NoteSink& sink) {
        const Origin origin = find_origin();
        Emitter emitter(melody_, sink, options_);
        if (has_voices_ && melody_.harmony == Harmony::triads) emitter.follow(first_sounding_voice(origin));
        const auto reader = make_reader(melody_, emitter, origin, options_);
        if (shares_) {
            measure_spans();
            reader->spans = &spans_;
        }
        DerivationOptions derivation = derivation_options();
        std::optional<Seeker> seeker;
        // Where a phrase depends on all phrases before it, none is skipped.
        if (fold_ && options_.from > 0 && !melody_.is_sequential()) {
            seeker.emplace(grammar_, *fold_, *reader);
            derivation.pruner = &*seeker;
        }
        // A piece may fit the budget even if the whole melody does not.
        const bool is_piece = !has_voices_ && !shares_ && options_.to < INT64_MAX;
        const bool is_long =
            static_cast<double>(options_.to - options_.from) > options_.budget * static_cast<double>(melody_.unit);
        if (!is_piece || is_long) require_affordable(plain_, true, options_.budget);
        try {
            derive(grammar_, *reader, derivation);
        } catch (const Enough&) {
            emitter.finish(options_.to);
        }
        reader->report_skipped(emitter.report);
        return emitter.report;
    }

private:
    DerivationOptions derivation_options() const {
        DerivationOptions derivation;
        derivation.interpreted = true;
        derivation.watch = [this, visited = 0.0](std::uint64_t symbols) mutable {
            // While no symbols are passed on, the watch is called every 2^16 nodes.
            visited += symbols > 0 ? static_cast<double>(symbols) : 65536.0;
            if (visited > 2 * options_.budget) {
                throw BudgetError(fmt::format(
                    "the piece lies too far into the curve: more than {:.0f} nodes would be visited to reach its "
                    "end{}",
                    options_.budget,
                    melody_.is_sequential()
                        ? ", as phrases that begin at bar lines or with rhythms of their own, breaths by level and "
                          "`leaps` are read from the beginning"
                        : ""));
            }
            if (options_.watch) options_.watch(symbols);
        };
        return derivation;
    }

    std::unique_ptr<Reader> make_reader(const Melody& melody, Emitter& emitter, Origin origin,
                                        const PlayOptions& options) const {
        const Reading reading{grammar_, lattice_, first_,  melody,      marks_,
                              emitter,  origin,   options, has_voices_, is_grid_ && !shares_};
        switch (melody.mapping) {
            case Mapping::symbols:
                return read_symbols(reading);
            case Mapping::counterpoint:
                return read_counterpoint(reading);
            case Mapping::runs:
                break;
        }
        return read_runs(reading);
    }

    /// The y that sounds the tonic. The first note is found while reading, except for a piece from the middle.
    Origin find_origin() const {
        if (melody_.mapping == Mapping::symbols || melody_.anchor == Anchor::piece) return {};
        if (melody_.anchor == Anchor::first_note) {
            if (options_.from == 0 || melody_.mapping == Mapping::counterpoint) return {};
            return {first_note()};
        }
        if (fold_ && melody_.mapping == Mapping::runs) {
            const GridStretch& whole = fold_->whole();
            const auto number = [](const Integer& value) {
                if (abs(value) >= farthest / 2) {
                    throw ScoreError("the curve is too large for its anchor: a smaller n is needed");
                }
                return value.convert_to<std::int64_t>();
            };
            if (melody_.anchor == Anchor::lowest_note) {
                return {whole.crossings[0] ? 2 * number(whole.crossings[0]->low) : 0};
            }
            if (melody_.anchor == Anchor::lowest_vertex) return {2 * number(whole.box[1].low)};
            return {2 * number((whole.box[1].low + whole.box[1].high) >> 1)};
        }
        return survey();
    }

    /// Options that play the whole melody.
    PlayOptions whole() const {
        PlayOptions all = options_;
        all.ahead = 0;
        all.degrees = all.phrase_ends = nullptr;
        all.from = 0;
        all.to = INT64_MAX;
        all.most_voices = std::numeric_limits<int>::max();
        return all;
    }

    /// Reads the word once without sound. @param prepare, examine  functions of the reader, before and after it
    template <class Prepare, class Examine>
    auto read_unheard(Prepare prepare, Examine examine) const {
        const PlayOptions all = whole();
        Melody silent = melody_;
        silent.range = Range::clamp;
        NullSink nobody;
        Emitter emitter(silent, nobody, all);
        const auto reader = make_reader(silent, emitter, {0}, all);
        prepare(*reader);
        try {
            derive(grammar_, *reader, derivation_options());
        } catch (const Enough&) {
        }
        return examine(*reader);
    }

    /// Measures how long the branches would last by themselves.
    void measure_spans() {
        require_affordable(plain_, true, options_.budget);
        const auto prepare = [&](Reader& reader) {
            reader.spans = &spans_;
            reader.measures_spans = true;
        };
        read_unheard(prepare, [](const Reader&) {});
    }

    /// The first voice of the whole melody that has notes; above 0 if all notes are in branches.
    int first_sounding_voice(Origin origin) const {
        class FirstVoice : public NoteSink {
        public:
            void notes(std::span<const Note> notes) override {
                for (const Note& note : notes) first = std::min(first, static_cast<int>(note.voice));
            }
            void finish(std::int64_t) override {}
            int first = std::numeric_limits<int>::max();
        };
        require_affordable(plain_, true, options_.budget);
        PlayOptions all = whole();
        all.ahead = options_.ahead;
        all.most_voices = options_.most_voices;
        all.drums_from = 0;
        Melody alone = melody_;
        alone.harmony = Harmony::none;
        FirstVoice sink;
        Emitter emitter(alone, sink, all);
        const auto reader = make_reader(alone, emitter, origin, all);
        derive(grammar_, *reader, derivation_options());
        return sink.first == std::numeric_limits<int>::max() ? 0 : sink.first;
    }

    Origin survey() const {
        require_affordable(plain_, true, options_.budget);
        const auto origin = [&](const Reader& reader) -> Origin {
            if (melody_.anchor == Anchor::lowest_note) {
                return {reader.lowest_degree() == unknown ? 0 : 2 * reader.lowest_degree()};
            }
            if (melody_.anchor == Anchor::lowest_vertex) return {2 * reader.lowest_vertex()};
            const std::int64_t sum = reader.lowest_vertex() + reader.highest_vertex();
            return {2 * (sum >= 0 ? sum / 2 : -((1 - sum) / 2))};
        };
        return read_unheard([](Reader&) {}, origin);
    }

    std::int64_t first_note() const {
        return read_unheard(
            [](Reader& reader) { reader.seeks_first_note = true; },
            [](const Reader& reader) { return reader.first_degree() == unknown ? 0 : 2 * reader.first_degree(); });
    }

    const Grammar& grammar_;
    const Grammar& plain_;
    const Melody& melody_;
    const Marks& marks_;
    const PlayOptions& options_;
    Lattice lattice_;
    bool is_grid_ = false;
    int first_ = 0;
    bool has_voices_ = false;  // brackets are voices
    bool shares_ = false;      // branches share durations
    std::vector<double> spans_;
    std::optional<MelodyFold> fold_;
};

}  // namespace

struct PlayableMelody::Word {
    double budget;   ///< limit that it was prepared with
    Grammar plain;   ///< without marks
    Grammar played;  ///< with marks, without contexts, parameters and chance
    Marks marks;

    const Grammar& measured() const { return marks.phrase || marks.whole > 0 ? plain : played; }
};

PlayableMelody::PlayableMelody(std::shared_ptr<const Grammar> grammar, const Melody& melody)
    : grammar_(std::move(grammar)), marked_for_(melody) {}

PlayableMelody::~PlayableMelody() = default;

std::shared_ptr<const PlayableMelody::Word> PlayableMelody::word(const PlayOptions& options) {
    constexpr std::size_t most_kept = std::size_t{1} << 20;  // symbols, so that many parts fit into memory
    if (word_ && word_->budget == options.budget) return word_;
    word_.reset();
    DerivationOptions whole_words;
    whole_words.limit_whole_words(options.budget);
    whole_words.watch = options.watch;
    Grammar plain = shorten(*grammar_);
    Marked with_marks = marked(plain, marked_for_);
    Grammar played = resolve_contexts(std::move(with_marks.grammar), whole_words);
    if (!played.is_plain()) played = write_out(played, whole_words);
    const bool is_small = played.axiom().size() <= most_kept;
    auto result = std::make_shared<const Word>(
        Word{options.budget, std::move(plain), std::move(played), std::move(with_marks.marks)});
    if (is_small) word_ = result;
    return result;
}

PlayReport PlayableMelody::play(const Melody& melody, NoteSink& sink, const PlayOptions& options) {
    const auto prepared = word(options);
    return Player(prepared->played, prepared->measured(), melody, prepared->marks, options).play(sink);
}

PlayReport play(const Grammar& grammar, const Melody& melody, NoteSink& sink, const PlayOptions& options) {
    return PlayableMelody(std::make_shared<const Grammar>(grammar), melody).play(melody, sink, options);
}

bool has_brackets(const Grammar& grammar) {
    const std::vector<char> reached = grammar.reachable();
    for (Symbol symbol = 0; symbol < reached.size(); ++symbol) {
        if (reached[symbol] && grammar.is_push(symbol)) return true;
    }
    return false;
}

std::string problem_of(const Grammar& grammar, const Melody& melody) {
    const std::int64_t order = order_of_phrases(melody, grammar.steps());
    const bool marks_phrases = order > 0 && order <= grammar.steps();
    const bool marks_levels = melody.follows_levels() && grammar.steps() > 0;
    if ((marks_phrases || marks_levels) && !shorten(grammar).with_marks(1)) return unmarkable(order > 0);
    const bool has_voices = melody.branches == Branches::voices && has_brackets(grammar);
    return has_voices && has_phrases(melody) ? phrases_of_voices : std::string();
}

Integer period(const Melody& melody) {
    using boost::multiprecision::lcm;
    Integer result = 4 * melody.meter.bar();
    result = lcm(result, Integer(melody.unit) * std::max<std::int64_t>(1, melody.rhythm.slots));
    result = lcm(result, Integer(2 * melody.swing_unit));
    return lcm(result, Integer(melody.meter.bar()) * std::max<std::size_t>(1, melody.progression.size()));
}

std::optional<MelodyCensus> census(const Grammar& given, const Melody& melody) {
    if (melody.mapping != Mapping::runs || !given.is_plain() || given.whole_word_steps() > 0) return std::nullopt;
    const Marked with_marks = marked(shorten(given), melody);
    const auto fold = fold_of(with_marks.grammar, melody, with_marks.marks.phrase);
    if (!fold) return std::nullopt;
    const GridStretch& whole = fold->whole();
    const bool is_sequential = (melody.restarts_rhythm() || melody.breathes_by_level) && whole.marks > 0;
    if (melody.leaps > 0 || is_sequential) return std::nullopt;
    MelodyCensus result;
    result.has_chance = melody.rhythm.has_chance();
    const auto notes_along = [&](std::size_t axis) {
        return melody.runs == Runs::each_step ? whole.steps[axis] : whole.runs[axis];
    };
    result.notes = notes_along(0);
    Integer steps = whole.length[0];
    if (melody.vertical == Vertical::glissando) {
        // A vertical run is the end of the note that leads into it, or else a note.
        result.notes += whole.runs[1] - whole.corners[0];
    }
    if (melody.vertical == Vertical::voice) {
        result.notes += notes_along(1);
        steps = std::max(steps, whole.length[1]);
    } else if (melody.vertical != Vertical::ignore) {
        steps += whole.length[1];
    }
    if (melody.rhythm.empty()) {
        result.ticks = steps * melody.unit;
    } else {
        const Integer hits = melody.rhythm.hits.size();
        const Integer slots = steps / hits * melody.rhythm.slots +
                              melody.rhythm.onset(Integer(steps % hits).convert_to<std::int64_t>());
        result.ticks = slots * melody.unit;
    }
    if (whole.marks > 0) result.ticks += (whole.marks - 1) * melody.breath;
    result.ticks += melody.lead();
    if (whole.crossings[0]) {
        result.height = whole.crossings[0]->high - whole.crossings[0]->low;
    }
    return result;
}

std::optional<NoteBox> note_box(const Grammar& given, const Melody& melody) {
    if (melody.mapping != Mapping::runs || !given.is_plain() || given.whole_word_steps() > 0) return std::nullopt;
    const auto fold = fold_of(shorten(given), melody, {});
    if (!fold) return std::nullopt;
    const GridStretch& whole = fold->whole();
    if (whole.length != whole.drawn || !whole.crossings[0]) return std::nullopt;
    const auto range = [](const GridStretch::Span& span) {
        return SourceRange{span.low.convert_to<double>(), span.high.convert_to<double>()};
    };
    // Every vertical run meets a horizontal one, so the horizontal runs are as wide as the curve.
    const bool are_vertical = melody.vertical == Vertical::voice || melody.vertical == Vertical::glissando;
    return NoteBox{range(whole.box[0]), range(are_vertical ? whole.box[1] : *whole.crossings[0])};
}

std::optional<std::int64_t> smallest_steps(const Grammar& given, const Melody& melody, std::int64_t phrases) {
    constexpr std::int64_t most_added = 24;
    for (std::int64_t steps = given.steps() + 1; steps <= given.steps() + most_added; ++steps) {
        const auto longer = given.with_steps(steps);
        if (!longer || !longer->is_plain() || longer->whole_word_steps() > 0) return std::nullopt;
        const Marked with_marks = marked(shorten(*longer), melody);
        const auto fold = fold_of(with_marks.grammar, melody, with_marks.marks.phrase);
        if (!fold) return std::nullopt;
        if (fold->whole().marks >= phrases) return steps;
    }
    return std::nullopt;
}

}  // namespace sikku
