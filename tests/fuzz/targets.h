// tests/fuzz/targets.h: what the fuzzers do with any bytes; tests/corpus_test.cpp does the same with the corpus.
#pragma once

#include "art/style/style.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/exact_counts.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/lattice.h"
#include "engine/geometry/space_turtle.h"
#include "engine/geometry/spline.h"
#include "engine/geometry/turtle.h"
#include "engine/import/import.h"
#include "engine/language/grammar.h"
#include "engine/measure/extent.h"
#include "engine/measure/fold.h"
#include "tests/maps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Two ways to the same answer disagree.
class Disagreement : public std::logic_error {
    using std::logic_error::logic_error;
};

inline void require(bool holds, const std::string& what) {
    if (!holds) throw Disagreement(what);
}

inline bool is_utf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
        if ((lead >= 0x80 && lead < 0xC2) || lead > 0xF4 || i + length > text.size()) return false;
        for (std::size_t k = 1; k < length; ++k) {
            if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return false;
        }
        const unsigned second = length > 1 ? static_cast<unsigned char>(text[i + 1]) : 0;
        if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) || (lead == 0xF0 && second < 0x90) ||
            (lead == 0xF4 && second > 0x8F)) {
            return false;
        }
        i += length;
    }
    return true;
}

/// What compiling bytes led to: a grammar, or at least one diagnostic that is an error.
struct Compiled {
    Pattern pattern;
    Diagnostics diagnostics;
    std::optional<Grammar> grammar;
};

/// Parses, checks and compiles as the program does. Every diagnostic must be readable text with a real place.
inline Compiled compile_bytes(std::string_view bytes) {
    Compiled result;
    Diagnostics& diagnostics = result.diagnostics;
    result.pattern = parse_pattern("fuzz.lsys", std::string(bytes), diagnostics);
    if (!diagnostics.is_unreadable()) {
        check_keys(result.pattern, diagnostics);
        Grammar grammar = compile_grammar(result.pattern, diagnostics);
        read_style(result.pattern, 96, diagnostics);
        if (!diagnostics.has_errors()) result.grammar = std::move(grammar);
    }
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
        require(is_utf8(diagnostic.text()), "a diagnostic is no valid UTF-8");
        require(diagnostic.file == "fuzz.lsys", "a diagnostic names no file: " + diagnostic.text());
        require(diagnostic.where.line >= 1 && diagnostic.where.column >= 1, "a place is counted from 1");
        const std::size_t line_end = diagnostic.excerpt.find('\n');
        require(line_end != std::string::npos && line_end <= 4 * 80, "an excerpt is at most 80 columns wide");
    }
    return result;
}

/// parse_pattern and compile_grammar on any bytes, and on every variant; the axiom reads back as it is printed.
inline void try_pattern(std::string_view bytes) {
    const Compiled compiled = compile_bytes(bytes);
    for (const Variant& variant : compiled.pattern.variants) {
        Pattern varied = compiled.pattern;
        Diagnostics diagnostics;
        apply_overrides(varied, variant.name.view(), {{"--set", "angle increment", "360/7"}}, diagnostics);
        compile_grammar(varied, diagnostics);
    }
    if (!compiled.grammar || compiled.grammar->axiom().empty()) return;
    const std::string text = to_text(*compiled.grammar, compiled.grammar->axiom());
    Pattern again = compiled.pattern;
    // The text states no parameters, which labels may show.
    std::erase_if(again.keys, [](const Key& key) { return key.name.starts_with("label "); });
    Diagnostics diagnostics;
    apply_overrides(again, "", {{"--set", "axiom", text}}, diagnostics);
    const Grammar grammar = compile_grammar(again, diagnostics);
    const bool finite = text.find("inf") == std::string::npos && text.find("nan") == std::string::npos;
    if (!finite) return;
    require(!diagnostics.has_errors(), "the printed axiom does not read back: " + text);
    require(to_text(grammar, grammar.axiom()) == text, "the printed axiom reads back as another: " + text);
}

/// Keeps the word.
class WordSink : public SymbolSink {
public:
    void symbols(const Run& run) override {
        require(!run.symbols.empty(), "an empty run");
        word.insert(word.end(), run.symbols.begin(), run.symbols.end());
    }
    void finish() override { ++finished; }
    Word word;
    int finished = 0;
};

/// Coordinates are finite, polygons have corners.
class StrictSpaceSink : public SpaceSink {
public:
    void segment(const glm::dvec3& from, const Pen&, const glm::dvec3& to, const Pen&, bool) override {
        require(is_finite(from) && is_finite(to), "a segment in space is not finite");
    }
    void polygon(std::span<const glm::dvec3> vertices, const Pen&) override {
        require(vertices.size() >= 3, "a polygon in space has fewer than three corners");
        for (const glm::dvec3& vertex : vertices) require(is_finite(vertex), "a corner in space is not finite");
    }
    void surface(const Surface&, const glm::dmat4x3& map, const Pen&) override {
        for (int axis = 0; axis < 4; ++axis) require(is_finite(map[axis]), "a surface is not finite");
    }
    void sphere(const glm::dvec3& centre, double radius, const Pen&) override {
        require(is_finite(centre) && std::isfinite(radius) && radius >= 0, "a sphere is not finite");
    }
    void label(std::string_view, const glm::dvec3& centre, double height, const Pen&) override {
        require(is_finite(centre) && height > 0, "a label is not finite");
    }

private:
    static bool is_finite(const glm::dvec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    }
};

/// Checks that strokes are begun and ended in turn and that points are where the last one ended.
class StrictPathSink : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen&) override {
        require(!open_, "a stroke begins within a stroke");
        open_ = true;
        see(start);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        require(open_ && !ends.empty(), "lines outside a stroke");
        for (const glm::dvec2 end : ends) see(end);
    }
    void curves(std::span<const glm::dvec2> controls) override {
        require(open_ && !controls.empty() && controls.size() % 3 == 0, "curves come in threes, within a stroke");
        for (const glm::dvec2 control : controls) see(control);
    }
    void change_pen(const Pen&) override { require(open_, "a pen changes outside a stroke"); }
    void end_stroke(bool) override {
        require(open_, "a stroke ends that was not begun");
        open_ = false;
    }
    void polygon(std::span<const glm::dvec2> vertices, const Pen&) override {
        require(vertices.size() >= 3, "a polygon has three corners");
        for (const glm::dvec2 vertex : vertices) see(vertex);
    }
    void disc(glm::dvec2 centre, double radius, const Pen&) override {
        see(centre);
        require(std::isfinite(radius) && radius >= 0, "a disc's radius is not finite");
    }
    bool is_open() const { return open_; }

private:
    static void see(glm::dvec2 point) {
        require(std::isfinite(point.x) && std::isfinite(point.y), "a point is not finite");
    }
    bool open_ = false;
};

inline bool agree(double a, double b, double scale) {
    return a == b || std::fabs(a - b) <= 1e-9 * std::max({1.0, scale, std::fabs(a), std::fabs(b)});
}

/// The fold's answers and the turtle's are the same; a fold does not include labels.
inline void compare(const Fold& fold, const Survey& survey, const Lattice& lattice, bool has_labels, double scale) {
    const auto same = [&](const std::array<Quantity, 4>& box, const Bounds& bounds, const char* name) {
        const std::array<double, 4> other = {bounds.low.x, bounds.low.y, bounds.high.x, bounds.high.y};
        for (std::size_t i = 0; i < 4; ++i) {
            require(agree(box[i].value, other[i], scale), std::string("fold and turtle disagree on ") + name + ": " +
                                                              std::to_string(box[i].value) + " and " +
                                                              std::to_string(other[i]));
        }
    };
    same(fold.box, survey.box, "the box");
    require(has_labels || fold.ink.has_value() == survey.ink.has_value(),
            "fold and turtle disagree on whether there is ink");
    if (fold.ink && !has_labels) same(*fold.ink, *survey.ink, "the ink");
    require(agree(fold.end[0].value, survey.end.x, scale) && agree(fold.end[1].value, survey.end.y, scale),
            "fold and turtle disagree on the end");
    const double gap = std::fabs(fold.heading - survey.heading);
    require(std::min(gap, 360 - gap) <= 1e-6,
            "fold and turtle disagree on the heading: " + std::to_string(fold.heading) + " and " +
                std::to_string(survey.heading));
    require(fold.depth == survey.depth, "fold and turtle disagree on the depth");
    if (lattice.rank > 0) require(fold.closed == survey.closed, "fold and turtle disagree on closedness");
}

/// Parameters, chance and cuts: streamed, on whole words, and as a plain word, the same comes out.
inline void try_modules(const Grammar& grammar, double most_nodes) {
    class ModuleSink : public SymbolSink {
    public:
        explicit ModuleSink(const Grammar& its) : grammar_(its) {}
        void symbols(const Run& run) override {
            std::size_t own = 0;
            for (const Symbol symbol : run.symbols) own += grammar_.symbols().at(symbol).arity;
            require(!run.symbols.empty() && own == run.arguments.size(),
                    "a run has not the arguments of its modules");
            word.symbols.insert(word.symbols.end(), run.symbols.begin(), run.symbols.end());
            word.arguments.insert(word.arguments.end(), run.arguments.begin(), run.arguments.end());
        }
        ModuleWord word;

    private:
        const Grammar& grammar_;
    };
    DerivationOptions options;
    options.limit_whole_words(40 * most_nodes);
    options.most_nodes = most_nodes;
    ModuleWord whole = grammar.axiom_modules();
    std::int64_t step = 0;
    for (const ScheduleRun& run : grammar.schedule()) {
        for (std::int64_t i = 0; i < run.steps; ++i) {
            whole = rewrite(grammar, grammar.tables()[run.table], whole, ++step, options);
        }
    }
    ModuleSink streamed(grammar);
    derive(grammar, streamed, options);
    require(to_text(grammar, whole) == to_text(grammar, streamed.word), "streamed and rewritten words differ");
    options.interpreted = true;
    ModuleSink interpreted(grammar);
    derive(grammar, interpreted, options);
    const Grammar written = write_out(grammar, options);
    require(written.is_plain() && to_text(written, written.axiom()) == to_text(grammar, interpreted.word),
            "the word written out is another");
    measure(grammar, most_nodes);
    StrictPathSink strict;
    const auto turtle = Turtle::drawing(grammar, strict, false);
    derive(grammar, *turtle, options);
    require(!strict.is_open(), "the last stroke is not ended");
}

/// Compiles bytes and derives them in every way there is, within a small budget.
/// The map, compared with that of the recursion.
inline void try_map(const Grammar& grammar) {
    constexpr double most_edges = 20'000;
    maps::SlowMap slow(*grammar.map());
    try {
        MapDerivation derivation(grammar, {most_edges});
        do {
            if (derivation.steps() > 0) {
                require(slow.text() == maps::text_of(derivation.map(), *grammar.map()), "maps differ");
            }
            require(maps::fault_of(derivation.map()).empty(), "not a planar map");
            std::int64_t before = derivation.steps();
            for (const ScheduleRun& run : grammar.schedule()) {
                if (before >= 0 && before < run.steps) {
                    slow.step(run.table, static_cast<std::uint32_t>(derivation.steps() + 1));
                }
                before -= run.steps;
            }
        } while (derivation.steps() < 200 && derivation.next());
    } catch (const BudgetError&) {  // as it should be
    }
}

inline void try_derivation(std::string_view bytes) {
    constexpr std::uint64_t most_nodes = 20'000;
    constexpr std::int64_t most_steps_here = 200;
    const Compiled compiled = compile_bytes(bytes);
    if (!compiled.grammar) return;
    if (compiled.grammar->map()) return try_map(*compiled.grammar);
    try {
        // Chains of any length are composed at once; what grows is told off.
        const Grammar whole = shorten(*compiled.grammar);
        const auto cut = whole.with_steps(std::min(whole.steps(), most_steps_here));
        if (!cut) return;
        if (!cut->is_plain() || cut->cut()) return try_modules(*cut, most_nodes);
        DerivationOptions options;
        options.limit_whole_words(40.0 * most_nodes);
        const Grammar grammar = resolve_contexts(*cut, options);
        require_affordable(grammar, true, most_nodes);
        std::uint64_t seen = 0;
        std::uint64_t calls = 0;
        const auto derived = [&](bool interpreted, std::size_t block_memory) {
            WordSink sink;
            DerivationOptions these = options;
            // What `interpret:` erases the forecast does not count, as it is not visited.
            these.watch = [&, interpreted](std::uint64_t symbols) {
                seen += symbols;
                if (seen <= most_nodes && ++calls <= 8 * most_nodes) return;
                require(!interpreted, "more is visited than the forecast tells");
                throw BudgetError("enough");
            };
            these.interpreted = interpreted;
            these.block_memory = block_memory;
            seen = calls = 0;
            derive(*cut, sink, these);
            require(sink.finished == 1, "finish() is called once");
            return std::move(sink.word);
        };
        const Word word = derived(false, std::size_t{1} << 20);
        require(word == derived(false, 0), "the word depends on the memory for blocks");

        // The slow and obvious way.
        Word obvious = cut->axiom();
        DerivationOptions large;
        large.longest_word = 64 * most_nodes;
        for (const ScheduleRun& run : cut->schedule()) {
            for (std::int64_t step = 0; step < run.steps; ++step) {
                obvious = rewrite(grammar, grammar.tables()[run.table], obvious, large);
            }
        }
        require(word == obvious, "streamed and rewritten words differ");
        const Word interpreted = derived(true, std::size_t{1} << 20);
        if (grammar.interpretation()) obvious = rewrite(grammar, *grammar.interpretation(), obvious);
        require(interpreted == obvious, "streamed and rewritten interpretations differ");

        if (const auto told = forecast(grammar, false); told && told->counts) {
            std::vector<std::uint64_t> counts(grammar.symbols().size(), 0);
            for (const Symbol symbol : word) ++counts[symbol];
            for (std::size_t i = 0; i < counts.size(); ++i) {
                require((*told->counts)[i] == counts[i], "the forecast counts other symbols than the word has");
            }
        } else {
            require(false, "a short word has no forecast");
        }

        std::optional<Survey> survey;
        std::string mistake;
        try {
            const auto turtle = Turtle::surveying(grammar);
            turtle->symbols({interpreted, -1});
            turtle->finish();
            survey = turtle->survey();
        } catch (const WordError& error) {
            mistake = error.what();
        }
        const bool out_of_range = mistake.find("leaves the range") != std::string::npos;
        double scale = 0;
        for (const Symbol symbol : interpreted) {
            const Command& command = grammar.symbols()[symbol].command;
            if (command.action == Action::draw || command.action == Action::move) scale += std::fabs(command.value);
        }
        try {
            if (const auto composed = fold(grammar)) {
                require(survey || out_of_range, "only the turtle finds fault: " + mistake);
                if (survey && scale < 1e15)
                    compare(*composed, *survey, make_lattice(grammar), grammar.has_labels(), scale);
            }
        } catch (const WordError& error) {
            require(!survey, std::string("only the fold finds fault: ") + error.what());
        }
        if (!survey) return;

        measure(grammar, most_nodes);
        StrictSpaceSink strict_space;
        const auto space = SpaceTurtle::make(grammar, &strict_space);
        space->symbols({interpreted, -1});
        space->finish();
        require(space->survey().drawn == survey->drawn && space->survey().moves == survey->moves &&
                    space->survey().depth == survey->depth,
                "the turtles of plane and space count otherwise");
        if (!grammar.is_spatial() && scale < 1e9) {
            require(std::hypot(space->survey().end.x - survey->end.x, space->survey().end.y - survey->end.y) <=
                        1e-6 * std::max(1.0, scale),
                    "in the plane the turtle of space ends elsewhere");
        }
        for (const bool moves_draw : {false, true}) {
            StrokeCensus census;
            const auto counting = Turtle::drawing(grammar, census, moves_draw);
            counting->symbols({interpreted, -1});
            counting->finish();
            StrictPathSink strict;
            SplineSink spline(strict, census.closed);
            const auto turtle =
                Turtle::drawing(grammar, moves_draw ? static_cast<PathSink&>(spline) : strict, moves_draw);
            turtle->symbols({interpreted, -1});
            turtle->finish();
            require(!strict.is_open(), "the last stroke is not ended");
        }
    } catch (const BudgetError&) {
    } catch (const WordError&) {
    }
}

/// Both importers on any bytes: what they say is readable and has a place, what they write is a pattern.
inline void try_import(std::string_view bytes) {
    const auto source = std::make_shared<const Source>("fuzz.l", std::string(bytes));
    import_format(bytes);
    for (const bool as_cpfg : {true, false}) {
        Diagnostics diagnostics;
        const auto systems =
            as_cpfg ? import_cpfg(source, source, diagnostics) : import_fractint(source, diagnostics);
        for (const Diagnostic& diagnostic : diagnostics.sorted()) {
            require(is_utf8(diagnostic.text()), "a diagnostic is no valid UTF-8");
            require(diagnostic.where.line >= 1 && diagnostic.where.column >= 1, "a place is counted from 1");
        }
        for (const ImportedSystem& system : systems) {
            require(!system.pattern.empty() || diagnostics.has_errors(), "a system is lost without a word");
            if (system.pattern.empty()) continue;
            const Compiled compiled = compile_bytes(system.pattern);
            std::string mistakes;
            for (const Diagnostic& diagnostic : compiled.diagnostics.list()) mistakes += diagnostic.text() + '\n';
            require(compiled.grammar.has_value(), "an imported pattern has mistakes: " + mistakes);
        }
    }
}

}  // namespace sikku
