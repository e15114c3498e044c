#include "art/drawing/line_bands.h"

#include "art/prints.h"
#include "art/writer/draw.h"
#include "engine/geometry/parallel_curve.h"
#include "engine/language/document.h"
#include "tests/files.h"
#include "tests/line_tools.h"
#include "tests/works.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace sikku::line_bands_test {

using namespace line_tools;

/// Strokes as a start and three control points for each curve.
class StrokeSink : public PolygonSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        strokes.push_back({start});
        pens.push_back(pen);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) {
            const Bezier curve = straight_curve(strokes.back().back(), end);
            strokes.back().insert(strokes.back().end(), curve.begin() + 1, curve.end());
        }
    }
    void curves(std::span<const glm::dvec2> controls) override {
        strokes.back().insert(strokes.back().end(), controls.begin(), controls.end());
    }
    void end_stroke(bool is_closed) override { closed.push_back(is_closed); }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}

    std::vector<std::vector<glm::dvec2>> strokes;
    std::vector<Pen> pens;
    std::vector<bool> closed;
};

struct Bands {
    StrokeSink sink;
    BandLook look;
    std::size_t crossings = 0;
};

Bands bands_of(const CurvedLines& lines, double width, std::optional<double> weave, ParallelStyle strands = {}) {
    Print print;
    print.style.stroke = {width, true, 1.0};
    print.style.palette = {Colour{0, 0, 0, 255}};
    print.style.weave = weave;
    print.style.parallel = strands;
    print.placement.step = 5;
    const CurveMeetings meetings = weave ? find_meetings(lines, 1'000'000, {}) : CurveMeetings();
    const LineBands bands(lines, meetings, print.style, {});
    Bands result;
    result.look = bands.look(print);
    bands.draw(
        print, [](std::size_t) { return -1; }, result.sink);
    result.crossings = bands.crossings();
    return result;
}

double distance_to(glm::dvec2 point, const std::vector<glm::dvec2>& chain) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const glm::dvec2 along = chain[i + 1] - chain[i];
        const double square = glm::dot(along, along);
        const double share = square > 0 ? std::clamp(glm::dot(point - chain[i], along) / square, 0.0, 1.0) : 0;
        least = std::min(least, glm::length(point - chain[i] - share * along));
    }
    return least;
}

TEST(ParallelCurve, KeepsItsDistance) {
    const std::vector<Bezier> curves = {{{{0, 0}, {1, 0}, {2, 1}, {2, 2}}},
                                        {{{0, 0}, {1, 2}, {2, -2}, {3, 0}}},
                                        {{{0, 0}, {0, 0}, {1, 1}, {2, 0}}},
                                        {{{0, 0}, {1, 0}, {2, 0}, {3, 0}}}};
    for (const Bezier& curve : curves) {
        for (const double distance : {0.1, -0.1, 0.25}) {
            std::vector<glm::dvec2> controls = {curve[0]};
            add_parallel(curve, distance, 1e-4, controls);
            const glm::dvec2 normal(-tangent_of(curve, 0).y, tangent_of(curve, 0).x);
            controls[0] = curve[0] + distance * normal;
            const auto base = chords(std::vector<glm::dvec2>(curve.begin(), curve.end()), 4000);
            for (const glm::dvec2 point : chords(controls, 20)) {
                EXPECT_NEAR(distance_to(point, base), std::fabs(distance), 1.5e-4);
            }
        }
    }
    EXPECT_NEAR(curvature_of(ring({0, 0}, 2).pieces[0].curve, 0.5), 0.5, 2e-3);
}

TEST(LineBands, StrandsOfARingAreRings) {
    const Bands bands = bands_of(ring({0, 0}, 3), 0.1, {}, {3, 4});
    ASSERT_EQ(bands.sink.strokes.size(), 3u);
    EXPECT_EQ(bands.look.spacing, bands.look.wanted);
    std::vector<double> radii;
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(bands.sink.closed[i]);
        EXPECT_EQ(bands.sink.strokes[i].front(), bands.sink.strokes[i].back());
        radii.push_back(glm::length(bands.sink.strokes[i].front()));
        for (const glm::dvec2 at : chords(bands.sink.strokes[i])) EXPECT_NEAR(glm::length(at), radii[i], 0.001);
    }
    std::sort(radii.begin(), radii.end());
    EXPECT_NEAR(radii[0], 2.6, 1e-3);
    EXPECT_NEAR(radii[1], 3, 1e-3);
    EXPECT_NEAR(radii[2], 3.4, 1e-3);
}

TEST(LineBands, StrandsOfCornersMeetInMitres) {
    const Bands bands = bands_of(drawn_text("axiom: FFF+FFF+FFF+FFF\n").lines, 0.1, {}, {2, 4});
    ASSERT_EQ(bands.sink.strokes.size(), 2u);
    for (const auto& stroke : bands.sink.strokes) {
        double low = 1e9, high = -1e9;
        for (const glm::dvec2 at : stroke) {
            low = std::min(low, at.x);
            high = std::max(high, at.x);
        }
        EXPECT_NEAR(std::fabs(high - low - 3), 0.4, 1e-9);
        EXPECT_EQ(stroke.front(), stroke.back());
    }
}

TEST(LineBands, SpacingIsLimitedByTurnsAndNeighbours) {
    // The inner strand of a ring of radius 1 may go in by three quarters.
    const Bands tight = bands_of(ring({0, 0}, 1), 0.5, {}, {3, 4});
    EXPECT_EQ(tight.look.wanted, 2);
    EXPECT_LE(tight.look.spacing, 0.75 + 1e-3);
    EXPECT_LE(tight.look.width, 0.5 * tight.look.spacing * 1.2);
    // The bands of two rings 0.6 apart do not touch.
    const Bands apart = bands_of(joined({ring({0, 0}, 3), ring({6.6, 0}, 3)}), 0.2, {}, {3, 2});
    EXPECT_LT(apart.look.band(), 0.6);
    EXPECT_GT(apart.look.band(), 0.3);
    double nearest = 1e9;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 3; k < 6; ++k) {
            const auto other = chords(apart.sink.strokes[k]);
            for (const glm::dvec2 at : chords(apart.sink.strokes[i]))
                nearest = std::min(nearest, distance_to(at, other));
        }
    }
    EXPECT_GT(nearest, apart.look.width);
}

/// A leaf with a sharp turn at each end, which begins with one of its four curves.
CurvedLines leaf(std::size_t first, bool is_reversed) {
    const std::vector<Bezier> curves = {
        {{{0, 0.02}, {1, 1.2}, {3, 1.2}, {4, 0.02}}},
        {{{4, 0.02}, {4.01, 0.0082}, {4.01, -0.0082}, {4, -0.02}}},
        {{{4, -0.02}, {3, -1.2}, {1, -1.2}, {0, -0.02}}},
        {{{0, -0.02}, {-0.01, -0.0082}, {-0.01, 0.0082}, {0, 0.02}}},
    };
    CurvedLines lines;
    for (std::size_t i = 0; i < 4; ++i) {
        Bezier curve = curves[(is_reversed ? first + 4 - i : first + i) % 4];
        if (is_reversed) std::reverse(curve.begin(), curve.end());
        lines.pieces.push_back({curve, {}, false});
    }
    lines.lines.push_back({0, 4, true, 0});
    return lines;
}

/// Points inside of a tip are as far from the line as the strand everywhere: nothing doubles back, nothing is
/// missing.
TEST(LineBands, StrandsMeetInsideOfTips) {
    for (std::size_t first = 0; first < 4; ++first) {
        for (const bool is_reversed : {false, true}) {
            SCOPED_TRACE(std::to_string(first) + (is_reversed ? " reversed" : ""));
            const CurvedLines lines = leaf(first, is_reversed);
            const Bands bands = bands_of(lines, 0.1, {}, {5, 2});
            EXPECT_EQ(bands.look.spacing, bands.look.wanted) << "the tips do not push the strands together";
            std::vector<glm::dvec2> middle = {lines.pieces[0].curve[0]};
            for (const CurvePiece& piece : lines.pieces) {
                middle.insert(middle.end(), piece.curve.begin() + 1, piece.curve.end());
            }
            const auto base = chords(middle, 400);
            ASSERT_EQ(bands.sink.strokes.size(), 5u);
            int inside = 0;
            for (std::size_t i = 0; i < 5; ++i) {
                const auto& stroke = bands.sink.strokes[i];
                EXPECT_TRUE(bands.sink.closed[i]);
                EXPECT_LT(glm::length(stroke.front() - stroke.back()), 1e-8);
                double low = 1e9;
                double high = -1e9;
                const double offset = std::fabs(static_cast<double>(i) - 2) * bands.look.spacing;
                for (const glm::dvec2 at : chords(stroke, 40)) {
                    EXPECT_NEAR(distance_to(at, base), offset, 2e-3);
                    low = std::min(low, at.x);
                    high = std::max(high, at.x);
                }
                EXPECT_NEAR(low + high, 4, 1e-3);
                // Half a tip has an angle of about 50 degrees.
                if (offset > 0 && low > 0) {
                    ++inside;
                    EXPECT_NEAR(low, offset / 0.763, 0.06);
                }
            }
            EXPECT_EQ(inside, 2);
        }
    }
}

/// The shaped rims of kolams leave room for parallel lines that can be seen, and each strand is one closed line.
TEST(LineBands, RimsOfKolamsLeaveRoom) {
    for (const char* name : {"kolam-library/kolam-7-to-1-ed71zr94", "kolam-library/kolam-9-to-1-085zkcfp",
                             "kolam-library/kolam-11-6-idukku-d30xsr9p"}) {
        for (const int strands : {2, 3, 5}) {
            SCOPED_TRACE(std::string(name) + " " + std::to_string(strands));
            CurvedLines lines = drawn_pattern(name, "0").lines;
            // The invisible line that sets the dots is open.
            std::erase_if(lines.lines, [](const CurvedLines::Line& line) { return !line.is_closed; });
            std::erase_if(lines.pieces, [](const CurvePiece& piece) { return piece.pen.colour != 0; });
            const Bands bands = bands_of(lines, 0.16, {}, {strands, 2});
            EXPECT_GT(bands.look.band(), 0.2);
            EXPECT_EQ(bands.sink.strokes.size(), lines.lines.size() * static_cast<std::size_t>(strands));
            EXPECT_EQ(std::count(bands.sink.closed.begin(), bands.sink.closed.end(), true),
                      static_cast<std::ptrdiff_t>(bands.sink.closed.size()));
        }
    }
}

/// Every crossing interrupts its lower line, and what is drawn of different strokes keeps the gap.
TEST(LineBands, AWeaveLeavesRealGaps) {
    for (const char* name : {"kolams/anklets-of-krishna", "kolams/mountain-kolam", "kolams/bag-of-candies"}) {
        for (const int strands : {1, 2, 3}) {
            SCOPED_TRACE(std::string(name) + " " + std::to_string(strands));
            const Drawn kolam = drawn_pattern(name, "2");
            const double gap = 0.5;
            const Bands woven = bands_of(kolam.lines, 0.15, gap, {strands, 2});
            ASSERT_GT(woven.crossings, 0u);
            EXPECT_EQ(woven.crossings, kolam.examination.crossings);
            ASSERT_EQ(woven.sink.strokes.size(), static_cast<std::size_t>(strands) * woven.crossings);
            const double wanted = woven.look.width + woven.look.gap;
            double least = 1e9;
            std::vector<std::vector<glm::dvec2>> chains;
            for (const auto& stroke : woven.sink.strokes) chains.push_back(chords(stroke, 6));
            for (std::size_t i = 0; i < chains.size(); ++i) {
                for (std::size_t k = 0; k < chains.size(); ++k) {
                    if (i == k) continue;
                    for (const glm::dvec2 end : {chains[i].front(), chains[i].back()}) {
                        least = std::min(least, distance_to(end, chains[k]));
                    }
                }
            }
            // Strands of one band lie as near as their spacing.
            EXPECT_GT(least, 0.98 * (strands == 1 ? wanted : std::min(wanted, woven.look.spacing)));
        }
    }
}

TEST(LineBands, RefusesWeavesThatCannotBe) {
    EXPECT_THROW(bands_of(drawn_pattern("kolams/mango-leaves", "3").lines, 0.1, 0.5), std::runtime_error);
    CurvedLines lines = joined({ring({0, 0}, 1)});
    lines.lines.push_back({lines.pieces.size(), lines.pieces.size() + 1, false, 1});
    lines.pieces.push_back({straight_curve({0, 0}, {3, 0.1}), {}, true});
    EXPECT_THROW(bands_of(lines, 0.1, 0.5), std::runtime_error);
}

Document kolam_with(const std::vector<Setting>& settings) {
    const std::string text = contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/kolams/kooja-kolam.lsys");
    return parse("kooja.lsys", text).with(settings);
}

std::string svg_of(const std::vector<Setting>& settings, const OptionValues& values = {}) {
    return draw(kolam_with(settings), "svg", values);
}

TEST(LineWork, FillsEveryFieldOnceInCurves) {
    const std::string plain = svg_of({});
    const std::string filled =
        svg_of({{"fields", "fields", "chessboard"}, {"powders", "powders", "#112233 #445566"}});
    EXPECT_FALSE(has(plain, "#112233"));
    EXPECT_TRUE(has(filled, "#112233"));
    EXPECT_TRUE(has(filled, "#445566"));
    const Drawn kolam = drawn_pattern("kolams/kooja-kolam", "");
    EXPECT_EQ(count_of(filled, "<path") - count_of(plain, "<path"), kolam.examination.crossings + 1);
    // With none for those without a dot.
    const std::string dots_only =
        svg_of({{"fields", "fields", "chessboard"}, {"powders", "powders", "#112233 none"}});
    EXPECT_FALSE(has(dots_only, "#445566"));
    EXPECT_LT(dots_only.size(), filled.size());
}

TEST(LineWork, SameBytesEveryTime) {
    const std::vector<Setting> all = {
        {"fields", "fields", "by symmetry"}, {"weave", "weave", "yes"}, {"parallel", "parallel", "2"}};
    EXPECT_EQ(svg_of(all), svg_of(all));
}

TEST(LineWork, RefusesMoreThanTheBudgetAllows) {
    EXPECT_THROW(svg_of({{"fields", "fields", "chessboard"}, {"-n", "derivation length", "6"}}, {{"budget", "4e5"}}),
                 std::runtime_error);
}

/// The warnings of a print.
std::string warnings_of(const std::string& text) {
    return sikku::warnings_of(remarks_about(prints(), parse("work.lsys", text), "svg"));
}

TEST(LineWork, ReportsWhatHasNoEffectOrDoesNotFit) {
    const std::string ring = "axiom: F+F+F+F\nangle factor: 4\nstroke: 0.1 step black\n";
    const std::filesystem::path patterns = std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns";
    const std::string snake = contents(patterns / "kolams/snake-kolam.lsys");
    EXPECT_TRUE(has(warnings_of(ring + "weave: yes\n"), "'weave' has no effect: the lines do not cross"));
    EXPECT_TRUE(has(warnings_of(ring + "powders: lotus\n"), "'powders' has no effect"));
    EXPECT_EQ(warnings_of(ring + "powders: lotus\nfields: kind\n"), "");
    EXPECT_EQ(warnings_of(contents(patterns / "kolam-library/kolam-5x5-7761ybtk.lsys") + "\nweave: yes\n"), "");
    // Without a distance lines move closer as they have to; a distance that does not fit is reported.
    EXPECT_EQ(warnings_of(snake + "\nparallel: 3\n"), "");
    EXPECT_TRUE(has(warnings_of(snake + "\nparallel: 3 9\n"), "do not fit"));
    EXPECT_TRUE(has(error_of<std::runtime_error>(
                        [&] { warnings_of("axiom: F+F+F+F\nangle factor: 4\nstroke: none\nfields: kind\n"); }),
                    "need lines, and 'stroke' is none"));
}

}  // namespace sikku::line_bands_test
