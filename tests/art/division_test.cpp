// Tiles that divide: every division begins and ends with the pictures at rest, in pixels; the SVG holds the same
// tiles as prints, and style sheets whose key frames begin and end at rest.
#include "art/motion/division_drawing.h"
#include "art/motion/division_file.h"
#include "art/prints.h"
#include "art/writer/draw_options.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <cmath>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace sikku::division_test {

Document pattern(const std::string& name, int n, const std::string& variant = "") {
    return load(name, {variant, {{"-n", "derivation length", std::to_string(n)}}});
}

std::string svg(const Document& document, OptionValues values) {
    values.push_back({"size", "100x100mm"});
    return draw(document, "svg", values);
}

std::string message(const Document& document, const std::string& format, const OptionValues& values) {
    try {
        draw(document, format, values);
    } catch (const SettingError& error) {
        return error.option() + ": " + error.message();
    } catch (const PatternError& error) {
        return error.diagnostics().front().message;
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

/// Pixels of moments, all with the same place.
class Moments {
public:
    Moments(const Document& document, std::int64_t first, std::int64_t last) {
        Diagnostics diagnostics;
        style_ = read_style(document.pattern(), 96, diagnostics);
        division_ = std::make_shared<const Division>(
            make_division(document.grammar(), style_, options_, options_.reading(), first, last, 1e5));
    }
    const Division& division() const { return *division_; }
    std::vector<std::uint8_t> pixels(const DivisionMoment& moment) const {
        DivisionDrawing drawing(division_, moment, options_, options_.reading());
        Print print;
        print.page = {60, 60, 3};
        print.dpi = 100;
        print.style.stroke = style_.stroke;
        drawing.place(print);
        print.style = drawing.style();
        std::vector<std::uint8_t> bytes;
        const auto rendering = drawing.rendering(print);
        rendering->render(1, [&](int, int, std::span<const std::uint8_t> rows) {
            bytes.insert(bytes.end(), rows.begin(), rows.end());
        });
        return bytes;
    }
    /// The mean difference of values.
    double difference(const DivisionMoment& a, const DivisionMoment& b) const {
        const std::vector<std::uint8_t> one = pixels(a), other = pixels(b);
        EXPECT_EQ(one.size(), other.size());
        double sum = 0;
        for (std::size_t i = 0; i < one.size(); ++i) sum += std::abs(int{one[i]} - int{other[i]});
        return sum / static_cast<double>(one.size());
    }

private:
    DrawOptions options_;
    Style style_;
    std::shared_ptr<const Division> division_;
};

TEST(Division, BeginsAndEndsAtRest) {
    const std::vector<std::pair<std::string, DivisionKind>> patterns = {{"chair", DivisionKind::cut},
                                                                        {"pinwheel", DivisionKind::cut},
                                                                        {"fibonacci-squares", DivisionKind::cut},
                                                                        {"penrose-rhombs", DivisionKind::across},
                                                                        {"twin-dragon", DivisionKind::across},
                                                                        {"hat", DivisionKind::spread},
                                                                        {"spectre", DivisionKind::spread}};
    for (const auto& [name, kind] : patterns) {
        const Moments moments(pattern(name, 3), 0, 2);
        ASSERT_EQ(moments.division().stages.size(), 3U);
        for (std::size_t stage = 1; stage < 3; ++stage) {
            // A motion always takes one tile onto the middle of its family.
            const bool is_one =
                kind == DivisionKind::spread && moments.division().stages[stage - 1].tiles.size() == 1;
            EXPECT_EQ(static_cast<int>(moments.division().stages[stage].kind),
                      static_cast<int>(is_one ? DivisionKind::across : kind))
                << name;
            const double whole = moments.difference({stage - 1}, {stage});
            EXPECT_GT(whole, 1) << name;
            // Seams of tiles without outlines are seen for a moment.
            EXPECT_LT(moments.difference({stage - 1}, {stage, 1e-4}), 0.1 * whole) << name << stage;
            EXPECT_LT(moments.difference({stage, 1 - 1e-4}, {stage}), 0.1 * whole) << name << stage;
            EXPECT_GT(moments.difference({stage - 1}, {stage, 0.5}), 0.2 * whole) << name << stage;
        }
        EXPECT_LT(moments.difference({2}, {2, 1, 1e-3}), 1) << name;
        EXPECT_LT(moments.difference({0}, {2, 1, 1 - 1e-3}), 1) << name;
    }
}

TEST(Division, ChangesSteadily) {
    // No frame jumps: of 35 frames none changes more than a fifth of all changes.
    for (const char* name : {"chair", "penrose-rhombs", "hat"}) {
        const Moments moments(pattern(name, 3), 1, 2);
        double sum = 0, most = 0;
        for (int frame = 0; frame < 35; ++frame) {
            const double change = moments.difference({1, frame == 0 ? 1e-9 : frame / 35.0}, {1, (frame + 1) / 35.0});
            sum += change;
            most = std::max(most, change);
        }
        EXPECT_LT(most, sum / 5) << name;
    }
}

/// Path data of a group of tiles.
std::vector<std::string> paths(const pugi::xml_node& group) {
    std::vector<std::string> data;
    for (const auto& path : group.select_nodes(".//path")) data.emplace_back(path.node().attribute("d").value());
    return data;
}

TEST(DivisionSvg, HoldsTheTilesOfAllGenerations) {
    // Without lines a chair fills the same box in all generations, so that the last ones are those of a print.
    const OptionValues bare = {{"stroke", "none"}};
    OptionValues divided = bare;
    divided.push_back({"divide", ""});
    pugi::xml_document moving, print;
    ASSERT_TRUE(moving.load_string(svg(pattern("chair", 3), divided).c_str()));
    ASSERT_TRUE(print.load_string(svg(pattern("chair", 3), bare).c_str()));
    std::size_t number = 1;
    for (int i = 0; i <= 3; ++i, number *= 4) {
        const auto group = moving.select_node(fmt::format("//g[@class='g g{}']", i).c_str()).node();
        EXPECT_EQ(paths(group).size(), number);
        EXPECT_EQ(std::string(group.attribute("visibility").value()), i < 3 ? "hidden" : "") << "without animation";
        if (i < 3) continue;
        EXPECT_EQ(paths(group), paths(print.document_element()));
    }
}

TEST(DivisionSvg, HasKeyFramesThatBeginAndEndAtRest) {
    for (const char* name : {"chair", "penrose-rhombs", "hat"}) {
        const std::string text = svg(pattern(name, 2), {{"divide", "1"}, {"frame-time", "0.5"}, {"hold", "3"}});
        EXPECT_FALSE(has(text, "<script"));
        EXPECT_TRUE(has(text, "@media (prefers-reduced-motion: reduce)"));
        // Rests, divisions, the last rest, the fade.
        EXPECT_TRUE(has(text, fmt::format("animation: {}s", 2 * 0.5 + 2 * 1 + 3 + 0.8))) << name;
        std::set<std::string> defined, used;
        const std::regex definition("@keyframes ([a-z0-9]+) \\{(.*) \\}"), use("animation-name: ([a-z0-9]+)");
        for (std::sregex_iterator at(text.begin(), text.end(), definition), end; at != end; ++at) {
            defined.insert((*at)[1]);
            double last = -1;
            const std::string frames = (*at)[2];
            const std::regex frame("([0-9.]+)%\\{([^}]*)\\}");
            std::vector<std::string> values;
            for (std::sregex_iterator key(frames.begin(), frames.end(), frame); key != end; ++key) {
                EXPECT_GT(std::stod((*key)[1]), last);
                last = std::stod((*key)[1]);
                values.push_back((*key)[2]);
            }
            EXPECT_LE(last, 100);
            if ((*at)[1].str()[0] != 't') continue;
            EXPECT_TRUE(has(values.front(), "fill:var(--p)")) << "in the colour of the parent";
            EXPECT_TRUE(has(values.back(), "scale:1;"));
            EXPECT_TRUE(has(values.back(), "translate:calc(var(--u)*0px) calc(var(--v)*0px)"));
            EXPECT_TRUE(has(values.back(), "fill:inherit"));
        }
        for (std::sregex_iterator at(text.begin(), text.end(), use), end; at != end; ++at) used.insert((*at)[1]);
        EXPECT_EQ(defined, used);
        EXPECT_EQ(defined, (std::set<std::string>{"g0", "g1", "g2", "t1", "t2"}));
    }
}

TEST(DivisionSvg, HasLinesOfDecorationsAndFrames) {
    const std::string text = svg(pattern("penrose-rhombs", 2, "kolam"), {{"divide", ""}, {"title-line", "Title"}});
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(text.c_str()));
    for (int i = 0; i <= 2; ++i) {
        EXPECT_TRUE(document.select_node(fmt::format("//g[@class='g g{0}']//g[@class='l l{0}']", i).c_str()));
    }
    EXPECT_TRUE(document.select_node("//g[title='frame']//path"));
    EXPECT_TRUE(has(text, "@keyframes l2"));
}

TEST(DivisionGif, HasFramesOfTheTimesThatWereAskedFor) {
    const Document document = pattern("chair", 2);
    const OptionValues values = {
        {"divide", "0.4"}, {"frame-time", "0.5"}, {"hold", "1"}, {"size", "30x30mm"}, {"dpi", "60"}};
    const std::string bytes = draw(document, "gif", values);
    EXPECT_EQ(bytes, draw(document, "gif", values));
    std::vector<int> delays;
    for (std::size_t at = 0; (at = bytes.find("\x21\xf9\x04", at)) != std::string::npos; ++at) {
        delays.push_back(static_cast<unsigned char>(bytes[at + 4]) + 256 * static_cast<unsigned char>(bytes[at + 5]));
    }
    // Two divisions in tenths of 0.4 s, three rests, the fade in twentieths.
    ASSERT_EQ(delays.size(), 3U + 2 * 9 + 19);
    EXPECT_EQ(delays[0], 50);
    EXPECT_EQ(delays[1], 4);
    EXPECT_EQ(delays[10], 50);
    EXPECT_EQ(delays[20], 100);
}

TEST(Division, IsRefusedWithAReason) {
    const auto refused = [](const std::string& name, int n = 3, const std::string& format = "svg") {
        return message(pattern(name, n), format, {{"divide", ""}});
    };
    EXPECT_EQ(refused("hilbert"), "divide: this drawing has no tiles, which are polygons between { and }");
    EXPECT_EQ(refused("trihexagonal").substr(0, 21), "divide: its schedule ");
    EXPECT_EQ(refused("fibonacci-spiral").substr(0, 72),
              "divide: no scale keeps the generations of this pattern in one place: the");
    EXPECT_EQ(refused("rauzy", 8).substr(0, 79),
              "divide: no scale keeps the generations of this pattern in one place: their tile");
    EXPECT_EQ(refused("penrose-rhombs", 0),
              "divide: tiles divide between generations; expected a derivation length above 0");
    EXPECT_EQ(refused("cell-layer"), "divide: a .gif of a map always shows how cells divide");
    EXPECT_EQ(refused("chair", 3, "png"), "divide: only a .gif and an animated SVG show how tiles divide");
    EXPECT_TRUE(has(refused("penrose-rhombs", 12),
                    "more than the limit of 20000; the largest derivation length that fits is 8"));
    EXPECT_EQ(message(pattern("chair", 2), "svg", {{"divide", ""}, {"animate", ""}}),
              "animate: cannot be combined with 'divide', which has its own times");
}

}  // namespace sikku::division_test
