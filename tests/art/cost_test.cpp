// tests/art/cost_test.cpp: forecasts of prints grow with the work, and refusals come early.
#include "art/print/format.h"
#include "art/prints.h"
#include "engine/derivation/derivation.h"
#include "engine/language/pattern_library.h"
#include "tests/files.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace sikku::cost_test {

Document bundled_pattern(const std::string& name) {
    const PatternFile file = find_pattern(name, PatternLibrary(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns"));
    return parse(file.name, read_pattern(file));
}

Cost cost(const Document& document, const char* format, OptionValues values = {}) {
    return prints().plan(document, format, values)->forecast();
}

double own(const Cost& cost) {
    return cost.seconds - cost.shared_seconds;
}

TEST(PrintCost, LightTakesTimeAndMemory) {
    const Document plant = bundled_pattern("lilac");
    const double flat = own(cost(plant, "png", {{"light", "flat"}, {"size", "A5"}}));
    const double lit = own(cost(plant, "png", {{"size", "A5"}}));
    EXPECT_GT(lit, 1.3 * flat);
    EXPECT_LT(lit, 15 * flat);
    EXPECT_GT(lit, 1.5);
    EXPECT_LT(lit, 10);
    // The cost of light depends on pixels, not on lines.
    const double large = own(cost(plant, "png", {{"size", "A3"}}));
    EXPECT_GT(large, 2 * lit);
    EXPECT_LT(large, 5 * lit);
    const Document bush = bundled_pattern("bush-3d");
    const auto memory = [&](const char* light) {
        return cost(bush, "png", {{"size", "A3"}, {"light", light}}).memory;
    };
    EXPECT_GT(memory("sky"), memory("flat") + 50e6);
    EXPECT_GT(memory("sun"), memory("sky") + 100e6) << "maps of the sun";
}

TEST(PrintCost, PicturesGrowWithTheirPixels) {
    const Document snake = bundled_pattern("snake-kolam");
    for (const char* format : {"png", "tif", "jpg", "exr"}) {
        const double small = own(cost(snake, format, {{"size", "A4"}}));
        EXPECT_NEAR(own(cost(snake, format, {{"size", "A2"}})) / small, 4, 0.7) << format;
        EXPECT_NEAR(own(cost(snake, format, {{"size", "A4"}, {"dpi", "600"}})) / small, 4, 0.7) << format;
    }
    EXPECT_NEAR(cost(snake, "svg", {{"size", "A4"}}).seconds, cost(snake, "svg", {{"size", "A0"}}).seconds, 1e-3);
}

/// Parameters, chance and contexts: only deriving determines their lengths.
TEST(PrintCost, WordsOfUnknownLengthAreDerived) {
    const std::string drawn = "\nstroke: 0.2mm\n";
    for (const std::string rules : {"axiom: A(1)\nA(x) : x > 0 --> F(x)A(x+1)A(x+2)",
                                    "axiom: F\nF --> FF : 2\nF --> F+F : 1", "axiom: FFF\nF < F --> FF\nF --> FF"}) {
        const auto at = [&](int n) {
            return cost(parse("word.lsys", rules + drawn + "derivation length: " + std::to_string(n) + "\n"), "svg");
        };
        EXPECT_LT(at(4).seconds, 0.01) << rules;
        EXPECT_LT(at(4).memory, 12e6) << rules;
        // Twice as long with each step, whether they are read or extrapolated.
        for (const int n : {10, 14, 18, 20}) {
            const double growth = at(n + 1).bytes / at(n).bytes;
            EXPECT_GT(growth, 1.4) << rules << ' ' << n;
            EXPECT_LT(growth, 3) << rules << ' ' << n;
        }
    }
}

/// The forecast of a print's bytes, divided by the bytes made.
double forecast_share(const Document& given, const char* format, const OptionValues& given_values) {
    const auto [document, values] = assign(prints(), given, given_values);
    const auto work = prints().plan(document, format, values);
    MemoryDestination memory;
    work->make(memory, std::string("wall.") + format, {});
    double bytes = 0;
    for (const auto& [name, content] : memory.outputs()) bytes += static_cast<double>(content.size());
    return work->forecast().bytes / bytes;
}

TEST(PrintCost, SheetsHaveMarksAndThePatternInEachFile) {
    const Document snake = bundled_pattern("snake-kolam");
    for (const char* format : {"svg", "pdf", "eps", "png"}) {
        const double factor = std::string_view(format) == "png" ? 3.2 : 2;  // pictures compress more or less
        for (const OptionValues& values :
             {OptionValues{{"dot-spacing", "30mm"}, {"tile", "A4"}, {"dpi", "60"}},
              OptionValues{{"dot-spacing", "15mm"}, {"tile", "A4"}, {"dpi", "60"}, {"n", "6"}},
              OptionValues{{"size", "A1"}, {"tile", "A4"}, {"dpi", "60"}}}) {
            const double share = forecast_share(snake, format, values);
            EXPECT_GT(share, 1 / factor) << format << ' ' << values[0].text;
            EXPECT_LT(share, factor) << format << ' ' << values[0].text;
        }
    }
    const Document curve = bundled_pattern("hilbert");
    const double share = forecast_share(curve, "pdf", {{"step", "8mm"}, {"tile", "A4"}, {"repeat", "p1:3x2"}});
    EXPECT_NEAR(share, 1, 0.5);
    EXPECT_THROW(cost(curve, "pdf", {{"step", "300mm"}, {"tile", "A4"}}), std::runtime_error);  // over 400 sheets
}

/// Splines pass through moves, so that words without drawing symbols are drawn, too.
TEST(PrintCost, KolamsOfMovesGrowWithTheirWords) {
    for (const char* name : {"snake-kolam", "anklets-of-krishna"}) {
        const Document kolam = bundled_pattern(name);
        for (const int n : {5, 6, 7}) {
            const OptionValues values = {{"n", std::to_string(n)}};
            EXPECT_NEAR(forecast_share(kolam, "svg", values), 1, 0.5) << name << ' ' << n;
            const OptionValues dotted = {{"n", std::to_string(n)}, {"dots", ""}};
            EXPECT_NEAR(forecast_share(kolam, "svg", dotted), 1, 0.5) << name << ' ' << n;
            EXPECT_NEAR(forecast_share(kolam, "eps", dotted), 1, 0.5) << name << ' ' << n;
        }
    }
}

TEST(PrintCost, IsForecastForEveryFormat) {
    const Document dragon = bundled_pattern("dragon");
    const Document bush = bundled_pattern("bush-3d");
    for (const FormatInfo& row : print_formats()) {
        OptionValues values;
        if (row.kind == FormatKind::animation) values = {{"generations", "1:4"}};
        if (row.format == PrintFormat::stl) values = {{"relief", ""}};
        const Document& document = row.kind == FormatKind::model && row.format != PrintFormat::stl ? bush : dragon;
        const Cost found = cost(document, std::string(row.extension).c_str(), values);
        EXPECT_GT(found.seconds, found.shared_seconds) << row.extension;
        EXPECT_LT(found.seconds, 30) << row.extension;
        EXPECT_GT(found.memory, found.shared_memory) << row.extension;
        EXPECT_GT(found.bytes, 100) << row.extension;
        EXPECT_EQ(found.shared_seconds > 0.1, uses_image_module(row.format)) << row.extension;
    }
}

TEST(PrintCost, GenerationsAndLessonsAreMorePicturesThanOne) {
    const Document dragon = bundled_pattern("dragon");
    const OptionValues one = {{"generations", "8:8"}}, many = {{"generations", "1:8"}};
    EXPECT_GT(own(cost(dragon, "gif", many)), 3 * own(cost(dragon, "gif", one)));
    // On one page they share its pixels.
    EXPECT_LT(own(cost(dragon, "png", many)), 2 * own(cost(dragon, "png")));
    const Document snake = bundled_pattern("snake-kolam");
    EXPECT_GT(own(cost(snake, "gif", {{"lesson", ""}})), 20 * own(cost(snake, "svg")));
}

std::uint64_t work_before_refusal(const Document& document, const char* format, const OptionValues& values) {
    std::uint64_t units = 0;
    const Monitor monitor(
        nullptr, [](void* sum, std::uint64_t more) { *static_cast<std::uint64_t*>(sum) += more; }, &units);
    EXPECT_THROW(draw(document, format, values, monitor), BudgetError);
    return units;
}

TEST(Refusals, ViewsAreRefusedBeforeTheWalk) {
    const Document tree = parse("tree.lsys", "axiom: F\nderivation length: 25\nF --> FFF+F[F]F\nstroke: 0.2mm\n");
    EXPECT_LT(work_before_refusal(tree, "png", {{"size", "A2"}}), 20'000'000u);
    // The part in the window is a small one of the whole, and still too large.
    EXPECT_LT(work_before_refusal(tree, "svg", {{"window", "0,0,100000,100000"}}), 20'000'000u);
    // In a curve that covers no edge twice, a window shows few of the 4^25 lines.
    EXPECT_NO_THROW(draw(parse("hilbert.lsys",
                               "axiom: L\nderivation length: 25\nangle increment: 90\nL --> +RF-LFL-FR+\n"
                               "R --> -LF+RFR+FL-\nstroke: 0.2mm\n"),
                         "png", {{"window", "0,0,40,30"}, {"size", "40x30mm"}}));
}

}  // namespace sikku::cost_test
