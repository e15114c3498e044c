#include "art/kolam/fields.h"

#include "tests/line_tools.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <map>
#include <numbers>
#include <random>
#include <set>

namespace sikku::fields_test {

using namespace line_tools;

std::vector<Field> fields_of(const CurvedLines& lines) {
    return find_fields(lines, find_meetings(lines, 1'000'000, {}), {});
}

/// Throws points at a drawing: each lies in one field or outside, with the parity that counting lines gives.
void expect_right_at_random_points(const CurvedLines& lines, const std::vector<Field>& fields, int points) {
    std::vector<std::vector<glm::dvec2>> closed;
    glm::dvec2 low(1e9), high(-1e9);
    for (const CurvedLines::Line& line : lines.lines) {
        std::vector<glm::dvec2> outline = {lines.pieces[line.begin].curve[0]};
        for (std::size_t i = line.begin; i < line.end; ++i) {
            const Bezier& b = lines.pieces[i].curve;
            outline.insert(outline.end(), b.begin() + 1, b.end());
        }
        for (const glm::dvec2 at : outline) {
            low = {std::min(low.x, at.x), std::min(low.y, at.y)};
            high = {std::max(high.x, at.x), std::max(high.y, at.y)};
        }
        if (line.is_closed) closed.push_back(chords(outline));
    }
    std::vector<std::vector<glm::dvec2>> outlines;
    for (const Field& field : fields) outlines.push_back(chords(field.outline));
    std::mt19937 random(7);
    for (int i = 0; i < points; ++i) {
        const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
        const glm::dvec2 at(low.x + share() * (high.x - low.x), low.y + share() * (high.y - low.y));
        int turns = 0;
        for (const auto& outline : closed) turns += winding(outline, at);
        std::vector<std::size_t> within;
        for (std::size_t k = 0; k < fields.size(); ++k) {
            if (winding(outlines[k], at) != 0) within.push_back(k);
        }
        ASSERT_LE(within.size(), 1u) << at.x << ' ' << at.y;
        EXPECT_EQ(turns % 2 != 0, !within.empty() && fields[within[0]].is_odd) << at.x << ' ' << at.y;
        EXPECT_TRUE(turns == 0 || within.size() == 1) << at.x << " " << at.y;
    }
}

TEST(Fields, OfARing) {
    const auto fields = fields_of(ring({3, 4}, 2));
    ASSERT_EQ(fields.size(), 1u);
    EXPECT_NEAR(fields[0].area, 4 * std::numbers::pi, 1e-3);
    EXPECT_NEAR(fields[0].centroid.x, 3, 1e-6);
    EXPECT_NEAR(fields[0].centroid.y, 4, 1e-6);
    EXPECT_TRUE(fields[0].is_odd);
    EXPECT_EQ(fields[0].corners, 0u);
    EXPECT_EQ(fields[0].distance, 1u);
}

TEST(Fields, OfTwoRingsThatCross) {
    const CurvedLines lines = joined({ring({0, 0}, 1), ring({1, 0}, 1)});
    const auto fields = fields_of(lines);
    ASSERT_EQ(fields.size(), 3u);
    const double lens = 2 * std::numbers::pi / 3 - std::sqrt(3) / 2;
    double sum = 0;
    for (const Field& field : fields) {
        EXPECT_NEAR(field.area, field.is_odd ? std::numbers::pi - lens : lens, 1e-4);
        EXPECT_EQ(field.corners, 2u);
        EXPECT_EQ(field.distance, field.is_odd ? 1u : 2u);
        EXPECT_EQ(field.beside.size(), field.is_odd ? 1u : 2u);
        sum += field.area;
    }
    EXPECT_NEAR(sum, 2 * std::numbers::pi - lens, 1e-4);
    expect_right_at_random_points(lines, fields, 400);
}

TEST(Fields, HaveHoles) {
    // Four rings in each other, and two that are apart from them and lie in the second.
    const CurvedLines lines = joined({ring({0, 0}, 10), ring({0, 0}, 9), ring({0, -1}, 3), ring({0, -1}, 1),
                                      ring({5, 2}, 1.5), ring({0, 5}, 1.5)});
    const auto fields = fields_of(lines);
    ASSERT_EQ(fields.size(), 6u);
    std::multiset<std::uint32_t> distances;
    double sum = 0;
    for (const Field& field : fields) {
        distances.insert(field.distance);
        sum += field.area;
    }
    EXPECT_EQ(distances, (std::multiset<std::uint32_t>{1, 2, 3, 3, 3, 4}));
    EXPECT_NEAR(sum, 100 * std::numbers::pi, 0.05);
    expect_right_at_random_points(lines, fields, 600);
}

TEST(Fields, OfKolamsAgreeWithCountingLines) {
    for (const char* name : {"kolams/anklets-of-krishna", "kolams/bag-of-candies", "kolams/kooja-kolam",
                             "kolams/mountain-kolam", "kolams/scissors", "kolams/mango-leaves"}) {
        SCOPED_TRACE(name);
        const Drawn kolam = drawn_pattern(name, std::string(name) == "kolams/anklets-of-krishna" ? "4" : "");
        const auto fields = fields_of(kolam.lines);
        // Euler: a connected drawing has one field more than crossings; straight lines also touch.
        const KolamExamination& k = kolam.examination;
        EXPECT_EQ(fields.size(), k.is_spline ? k.crossings + 1 : k.faces);
        EXPECT_EQ(std::count_if(fields.begin(), fields.end(), [](const Field& field) { return field.is_odd; }),
                  static_cast<std::ptrdiff_t>(k.dots.size()));
        expect_right_at_random_points(kolam.lines, fields, 300);
    }
}

TEST(Fields, OfStraightLinesThatTouchCrossAndRepeat) {
    for (const char* word :
         {"F+F+F+F+F+F+F+F", "FF+F+F+F+FF+F+F", "F+F+F+FF+F+F+F", "FF+FF+FF+FFf(0.5)", "FFF+FF+FF+FFF+FFFF+F+FFFF"}) {
        SCOPED_TRACE(word);
        const Drawn drawing = drawn_text("axiom: " + std::string(word) + "\n");
        const auto fields = fields_of(drawing.lines);
        if (drawing.examination.open_lines == 0) {
            EXPECT_EQ(fields.size(), drawing.examination.faces);
        }
        expect_right_at_random_points(drawing.lines, fields, 200);
    }
}

TEST(Fields, AreNotDividedByOpenLines) {
    CurvedLines lines = joined({ring({0, 0}, 1)});
    lines.lines.push_back({lines.pieces.size(), lines.pieces.size() + 1, false, 1});
    lines.pieces.push_back({straight_curve({-3, 0}, {3, 0.1}), {}, true});
    EXPECT_EQ(fields_of(lines).size(), 1u);
}

TEST(Fields, NeighboursShareTheirCorners) {
    const Drawn kolam = drawn_pattern("kolams/kooja-kolam", "1");
    std::map<std::pair<double, double>, int> corners;
    for (const Field& field : fields_of(kolam.lines)) {
        EXPECT_EQ(field.outline.front(), field.outline.back());
        for (std::size_t i = 0; i + 1 < field.outline.size(); i += 3) {
            ++corners[{field.outline[i].x, field.outline[i].y}];
        }
    }
    int shared = 0;
    for (const auto& [place, times] : corners) shared += times > 1 ? 1 : 0;
    EXPECT_GE(static_cast<std::uint64_t>(shared), kolam.examination.crossings);
}

TEST(Fields, RefusesCurvesThatRunAlongEachOther) {
    CurvedLines lines = joined({ring({0, 0}, 1), ring({0, 0}, 1)});
    EXPECT_THROW(find_meetings(lines, 1'000'000, {}), std::runtime_error);
}

TEST(FieldClasses, FollowTheSymmetry) {
    for (const char* name : {"kolams/kooja-kolam", "kolams/anklets-of-krishna", "kolams/scissors"}) {
        SCOPED_TRACE(name);
        const Drawn kolam = drawn_pattern(name, std::string(name) == "kolams/anklets-of-krishna" ? "4" : "2");
        const auto fields = fields_of(kolam.lines);
        const KolamSymmetry& symmetry = kolam.examination.symmetry;
        ASSERT_GT(symmetry.mirrors, 0u);
        const glm::dvec2 centre = kolam.examination.centre;
        const glm::dvec2 axis(std::cos(2 * symmetry.axis), std::sin(2 * symmetry.axis));
        for (const FieldsBy by : {FieldsBy::chessboard, FieldsBy::kind, FieldsBy::distance, FieldsBy::centre,
                                  FieldsBy::strand, FieldsBy::symmetry}) {
            const auto classes = classify(fields, by, symmetry, centre, {});
            for (std::size_t i = 0; i < fields.size(); ++i) {
                const glm::dvec2 from = fields[i].centroid - centre;
                const glm::dvec2 image =
                    centre + glm::dvec2(axis.x * from.x + axis.y * from.y, axis.y * from.x - axis.x * from.y);
                std::size_t found = fields.size();
                for (std::size_t k = 0; k < fields.size(); ++k) {
                    if (glm::length(fields[k].centroid - image) < 1e-6) found = k;
                }
                ASSERT_LT(found, fields.size());
                EXPECT_EQ(classes[found], classes[i]) << static_cast<int>(by);
            }
        }
        // Orbits are no larger than the group, and neighbours differ in parity.
        const auto orbits = classify(fields, FieldsBy::symmetry, symmetry, centre, {});
        std::map<std::uint32_t, std::uint32_t> sizes;
        for (std::size_t i = 0; i < fields.size(); ++i) {
            ++sizes[orbits[i]];
            for (const std::uint32_t other : fields[i].beside) EXPECT_NE(orbits[i] % 2, orbits[other] % 2);
        }
        for (const auto& [orbit, size] : sizes) {
            EXPECT_EQ(2 * symmetry.rotations % size, 0u);
        }
    }
}

TEST(FieldClasses, ByDistanceChangeByOneAtMost) {
    const Drawn kolam = drawn_pattern("kolams/kooja-kolam", "");
    const auto fields = fields_of(kolam.lines);
    for (const FieldsBy by : {FieldsBy::distance, FieldsBy::centre}) {
        const auto classes = classify(fields, by, kolam.examination.symmetry, kolam.examination.centre, {});
        EXPECT_EQ(*std::min_element(classes.begin(), classes.end()), 0u);
        EXPECT_GT(*std::max_element(classes.begin(), classes.end()), 3u);
        for (std::size_t i = 0; i < fields.size(); ++i) {
            for (const std::uint32_t other : fields[i].beside) {
                EXPECT_LE(std::abs(static_cast<int>(classes[i]) - static_cast<int>(classes[other])), 1);
            }
        }
    }
}

}  // namespace sikku::fields_test
