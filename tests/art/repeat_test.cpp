// Repeats of a drawing: the group is recognised from the points of the SVG alone.
#include "art/print/repeat.h"

#include "art/print/crop.h"
#include "art/prints.h"
#include "engine/base/output.h"
#include "engine/derivation/derivation.h"
#include "tests/works.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace sikku::repeat_test {

using Points = std::vector<glm::dvec2>;

/// A hook without any symmetry, in one stroke.
constexpr const char* hook = "axiom: FFF-FF-F\nangle increment: 90\nstroke: 0.1mm black\n";

/// The points of each stroke of an SVG, in millimetres. Paths have the commands M, m, h, v and l.
std::vector<Points> paths_of(const std::string& svg) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    std::vector<Points> paths;
    for (const auto& found : document.select_nodes("//path")) {
        const std::string d = found.node().attribute("d").value();
        Points points;
        glm::dvec2 at(0.0);
        char command = 0;
        for (const char* next = d.c_str(); *next != 0;) {
            if (std::isalpha(static_cast<unsigned char>(*next)) != 0) {
                command = *next++;
                continue;
            }
            if (*next == ' ' || *next == ',') {
                ++next;
                continue;
            }
            char* end = nullptr;
            const double value = std::strtod(next, &end) / 1000;
            next = end;
            const auto second = [&] {
                const double other = std::strtod(next, &end) / 1000;
                next = end;
                return other;
            };
            if (command == 'M' || command == 'm') {
                at = command == 'M' ? glm::dvec2(value, second()) : at + glm::dvec2(value, second());
                if (!points.empty()) paths.push_back(std::move(points));
                points.clear();
            } else if (command == 'h') {
                at.x += value;
            } else if (command == 'v') {
                at.y += value;
            } else {
                at += glm::dvec2(value, second());
            }
            points.push_back(at);
        }
        paths.push_back(std::move(points));
    }
    return paths;
}

std::vector<Points> drawn(const std::string& repeat) {
    return paths_of(draw(parse("hook.lsys", hook), "svg", {{"repeat", repeat}, {"size", "3000x3000mm"}}));
}

constexpr double close = 0.02;  // millimetres: coordinates are rounded to a thousandth

/// x' = linear x + shift.
struct Isometry {
    glm::dmat2x2 linear{1.0};
    glm::dvec2 shift{0.0};
    glm::dvec2 operator()(glm::dvec2 point) const { return linear * point + shift; }
};

/// From three corners of a hook to those of another.
Isometry between(const Points& from, const Points& to) {
    const glm::dmat2x2 source(from[3] - from[0], from.back() - from[3]);
    const glm::dmat2x2 target(to[3] - to[0], to.back() - to[3]);
    Isometry map;
    map.linear = target * glm::inverse(source);
    map.shift = to[0] - map.linear * from[0];
    return map;
}

glm::dvec2 centre_of(const Points& points) {
    glm::dvec2 sum(0.0);
    for (const glm::dvec2 point : points) sum += point;
    return sum / static_cast<double>(points.size());
}

/// The isometries that map the most central hook to all others.
struct Symmetries {
    explicit Symmetries(const std::vector<Points>& copies) {
        glm::dvec2 middle(0.0);
        for (const Points& copy : copies) middle += centre_of(copy) / static_cast<double>(copies.size());
        const Points& base = *std::min_element(copies.begin(), copies.end(), [&](const Points& a, const Points& b) {
            return glm::length(centre_of(a) - middle) < glm::length(centre_of(b) - middle);
        });
        at = centre_of(base);
        for (const Points& copy : copies) {
            const Isometry map = between(base, copy);
            const double determinant = glm::determinant(map.linear);
            EXPECT_NEAR(std::fabs(determinant), 1, 1e-3);
            if (determinant > 0) {
                const double angle = std::acos(std::clamp((map.linear[0].x + map.linear[1].y) / 2, -1.0, 1.0));
                if (angle < 0.01) {
                    if (glm::length(map.shift) > close) translations.push_back(map.shift);
                    continue;
                }
                const int order = static_cast<int>(std::lround(2 * std::acos(-1.0) / angle));
                rotations.push_back({order, glm::inverse(glm::dmat2x2(1.0) - map.linear) * map.shift});
                continue;
            }
            // The axis of a reflection runs along (1 + a, b) or (b, 1 - a).
            glm::dvec2 along(1 + map.linear[0].x, map.linear[0].y);
            if (glm::length(along) < 0.5) along = {map.linear[0].y, 1 - map.linear[0].x};
            along = glm::normalize(along);
            const double glide = glm::dot(map.shift, along);
            const glm::dvec2 on = (map.shift - glide * along) / 2.0;
            axes.push_back({on, along, std::fabs(glide) < close});
        }
        cell = 1e300;
        for (const glm::dvec2 translation : translations) cell = std::min(cell, glm::length(translation));
    }

    struct Rotation {
        int order;
        glm::dvec2 centre;
    };
    struct Axis {
        glm::dvec2 on, along;
        bool is_mirror;
    };
    static bool lies_on(const Axis& axis, glm::dvec2 point) {
        const glm::dvec2 from = point - axis.on;
        return std::fabs(from.x * axis.along.y - from.y * axis.along.x) < 3 * close;
    }
    bool on_mirror(glm::dvec2 point) const {
        return std::any_of(axes.begin(), axes.end(),
                           [&](const Axis& axis) { return axis.is_mirror && lies_on(axis, point); });
    }
    bool has_mirror() const {
        return std::any_of(axes.begin(), axes.end(), [](const Axis& axis) { return axis.is_mirror; });
    }
    /// True if a glide reflection near the middle has an axis that is not a mirror's.
    bool has_glide() const {
        return std::any_of(axes.begin(), axes.end(), [&](const Axis& axis) {
            const glm::dvec2 foot = axis.on + glm::dot(at - axis.on, axis.along) * axis.along;
            return !axis.is_mirror && glm::length(foot - at) < cell && !on_mirror(foot);
        });
    }
    int directions_of_mirrors() const {
        std::vector<glm::dvec2> found;
        for (const Axis& axis : axes) {
            if (!axis.is_mirror) continue;
            const bool is_known = std::any_of(found.begin(), found.end(), [&](glm::dvec2 other) {
                return std::fabs(other.x * axis.along.y - other.y * axis.along.x) < 1e-3;
            });
            if (!is_known) found.push_back(axis.along);
        }
        return static_cast<int>(found.size());
    }
    int highest_order() const {
        int order = 1;
        for (const Rotation& rotation : rotations) order = std::max(order, rotation.order);
        return order;
    }
    bool all_centres_on_mirrors(int order) const {
        return std::all_of(rotations.begin(), rotations.end(), [&](const Rotation& rotation) {
            return rotation.order != order || glm::length(rotation.centre - at) > cell || on_mirror(rotation.centre);
        });
    }

    glm::dvec2 at{0.0};
    double cell = 0;  ///< length of the shortest translation
    std::vector<glm::dvec2> translations;
    std::vector<Rotation> rotations;
    std::vector<Axis> axes;
};

/// Source: Schattschneider 1978, The plane symmetry groups: their recognition and notation, Am. Math. Monthly 85.
std::string recognised(const Symmetries& found) {
    const bool has_mirror = found.has_mirror();
    switch (found.highest_order()) {
        case 1:
            if (has_mirror) return found.has_glide() ? "cm" : "pm";
            return found.has_glide() ? "pg" : "p1";
        case 2:
            if (!has_mirror) return found.has_glide() ? "pgg" : "p2";
            if (found.directions_of_mirrors() == 1) return "pmg";
            return found.all_centres_on_mirrors(2) ? "pmm" : "cmm";
        case 3:
            if (!has_mirror) return "p3";
            return found.all_centres_on_mirrors(3) ? "p3m1" : "p31m";
        case 4:
            if (!has_mirror) return "p4";
            return found.all_centres_on_mirrors(4) ? "p4m" : "p4g";
        case 6:
            return has_mirror ? "p6m" : "p6";
        default:
            return "none";
    }
}

const std::vector<std::string> wallpapers = {"p1", "p2",  "pm",  "pg", "cm",   "pmm",  "pmg", "pgg", "cmm",
                                             "p4", "p4m", "p4g", "p3", "p3m1", "p31m", "p6",  "p6m"};

TEST(Repeat, WallpapersHaveTheGroupOfTheirName) {
    for (const std::string& name : wallpapers) {
        SCOPED_TRACE(name);
        const std::vector<Points> copies = drawn(name + ":7x7");
        ASSERT_EQ(copies.size(), static_cast<std::size_t>(parse_repeat(name + ":7x7")->copies()));
        const Symmetries found(copies);
        EXPECT_EQ(recognised(found), name);
        EXPECT_GE(found.translations.size(), 48u);
    }
}

/// Every symmetry of the middle maps each copy around it to another copy.
TEST(Repeat, WallpapersAreClosedUnderTheirSymmetries) {
    for (const std::string& name : wallpapers) {
        SCOPED_TRACE(name);
        const std::vector<Points> copies = drawn(name + ":7x7");
        const Symmetries found(copies);
        const double reach = 1.2 * found.cell;
        const auto is_near = [&](const Points& copy) { return glm::length(centre_of(copy) - found.at) < reach; };
        const auto base = std::min_element(copies.begin(), copies.end(), [&](const Points& a, const Points& b) {
            return glm::length(centre_of(a) - found.at) < glm::length(centre_of(b) - found.at);
        });
        int checked = 0;
        for (const Points& other : copies) {
            if (!is_near(other)) continue;
            const Isometry map = between(*base, other);
            for (const Points& copy : copies) {
                if (!is_near(copy)) continue;
                const bool is_there = std::any_of(copies.begin(), copies.end(), [&](const Points& image) {
                    return glm::length(image.front() - map(copy.front())) < close &&
                           glm::length(image.back() - map(copy.back())) < close;
                });
                EXPECT_TRUE(is_there);
                ++checked;
            }
        }
        EXPECT_GT(checked, 8);
    }
}

double distance(const Points& a, const Points& b) {
    double least = 1e300;
    const auto to_segment = [](glm::dvec2 point, glm::dvec2 from, glm::dvec2 to) {
        const glm::dvec2 way = to - from;
        const double t = std::clamp(glm::dot(point - from, way) / glm::dot(way, way), 0.0, 1.0);
        return glm::length(point - from - t * way);
    };
    for (const auto& [one, two] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        for (const glm::dvec2 point : *one) {
            for (std::size_t i = 0; i + 1 < two->size(); ++i) {
                least = std::min(least, to_segment(point, (*two)[i], (*two)[i + 1]));
            }
        }
    }
    return least;
}

TEST(Repeat, CopiesKeepTheirDistance) {
    for (std::string name :
         {"p2:2x2", "cmm:2x2", "p4:2x2", "p4m:2x2", "p4g:2x2", "p3:2x2", "p3m1:2x2", "p31m:2x2", "p6:2x2", "p6m:2x2",
          "packed:3x3", "ring:1", "ring:2", "ring:3", "ring:7", "frieze:4", "frieze-p2mg:2"}) {
        SCOPED_TRACE(name);
        const std::vector<Points> copies = drawn(name + ",gap=0.5");
        const double step = glm::length(copies[0][1] - copies[0][0]);
        double least = 1e300;
        for (std::size_t i = 0; i < copies.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) least = std::min(least, distance(copies[i], copies[j]));
        }
        EXPECT_GE(least, 0.5 * step - close);
        // The cell is the least in which the convex hulls have room.
        if (copies.size() > 1 && !name.starts_with("cmm")) {
            EXPECT_LT(least, 2.6 * step);
        }
    }
}

TEST(Repeat, RingsAreTurnedEvenly) {
    const std::vector<Points> copies = drawn("ring:12");
    ASSERT_EQ(copies.size(), 12u);
    for (std::size_t i = 0; i < 12; ++i) {
        const Isometry turn = between(copies[i], copies[(i + 1) % 12]);
        EXPECT_NEAR(turn.linear[0].x, std::cos(std::acos(-1.0) / 6), 1e-3);
        const glm::dvec2 centre = glm::inverse(glm::dmat2x2(1.0) - turn.linear) * turn.shift;
        EXPECT_NEAR(glm::length(centre - centre_of(copies[0])), glm::length(centre - centre_of(copies[5])), close);
    }
}

TEST(Repeat, IsParsed) {
    EXPECT_EQ(parse_repeat("p4m:3x4")->rows, 4);
    EXPECT_EQ(parse_repeat("P4M")->copies(), 72);
    EXPECT_EQ(parse_repeat("frieze")->columns, 5);
    EXPECT_EQ(parse_repeat("ring:8")->copies(), 8);
    EXPECT_EQ(parse_repeat(" ring : 8 , gap=-2 ")->gap, -2);
    EXPECT_DOUBLE_EQ(parse_repeat("p1:2x2,gap=5%")->gap, 0.05);
    for (const char* bad :
         {"", "p5", "p4:3", "frieze:3x3", "ring:0", "ring:x", "p1:0x3", "p1:101x100", "ring:10001", "p4:2x2,gap",
          "packed:3", "p4:2x2,gap=x", "p4:2x2,gap=nan", "p4:2x2x2", "p4:99999999999x2", "gap=3"}) {
        EXPECT_FALSE(parse_repeat(bad)) << bad;
    }
}

TEST(Repeat, WorksWithDotsColoursAndPlots) {
    const Document kolam = parse("kolam.lsys",
                                 "axiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 1\n"
                                 "angle increment: 90\nstroke: 0.2 step #f2b632\nground: #8c3b2a\n");
    const std::string one = draw(kolam, "svg", {{"dots", ""}});
    const std::string many = draw(kolam, "svg", {{"dots", ""}, {"repeat", "pmm:2x2"}, {"colour-by", "strand"}});
    EXPECT_GT(count_of(one, "<circle"), 3u);
    EXPECT_EQ(count_of(many, "<circle"), 16 * count_of(one, "<circle"));
    const std::string plot = draw(kolam, "hpgl", {{"repeat", "ring:5"}});
    EXPECT_EQ(count_of(plot, "PD"), 5 * count_of(draw(kolam, "hpgl", {}), "PD"));
}

/// A weave cuts a line into pieces, which are not lines of their own.
TEST(Repeat, CountsLinesBeforeTheyAreWoven) {
    const Document kolam = parse("kolam.lsys",
                                 "axiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 1\n"
                                 "angle increment: 90\n");
    for (const OptionValues& options :
         {OptionValues{}, OptionValues{{"weave", "yes"}}, OptionValues{{"parallel", "3"}}}) {
        OptionValues values = options;
        values.push_back({"repeat", "p1:2x3"});
        EXPECT_TRUE(made_work(prints(), kolam, "svg", values).remarks.starts_with("p1: 6 copies, 6 lines\n"));
    }
}

/// Copies reach the edges of the page on all sides, and nothing beyond them.
TEST(Repeat, FillsThePage) {
    const Document document = parse("hook.lsys", hook);
    for (const char* group : {"p1", "cmm", "p4m", "p31m"}) {
        for (const char* rotate : {"0", "25"}) {
            SCOPED_TRACE(std::string(group) + rotate);
            const OptionValues values = {
                {"repeat", std::string(group) + ":6xfill"}, {"size", "200x300mm"}, {"rotate", rotate}};
            Box box;
            for (const Points& path : paths_of(draw(document, "svg", values))) {
                for (const glm::dvec2 point : path) box.add(point);
            }
            constexpr double pen = 0.1 + close;
            EXPECT_NEAR(box.low.x, 0, 12);
            EXPECT_NEAR(box.low.y, 0, 12);
            EXPECT_NEAR(box.high.x, 200, 12);
            EXPECT_NEAR(box.high.y, 300, 12);
            EXPECT_GE(std::min(box.low.x, box.low.y), -pen);
            EXPECT_LE(box.high.x, 200 + pen);
            EXPECT_LE(box.high.y, 300 + pen);
            OptionValues plotted = values;
            plotted.push_back({"plotter", "true"});
            Box plot;
            for (const Points& path : paths_of(draw(document, "svg", plotted))) {
                for (const glm::dvec2 point : path) plot.add(point);
            }
            EXPECT_GE(std::min(plot.low.x, plot.low.y), 10 - close) << "the margin";
            EXPECT_LE(plot.high.x, 190 + close);
            EXPECT_LE(plot.high.y, 290 + close);
        }
    }
    EXPECT_EQ(parse_repeat("p4m:fill")->columns, 3);
    EXPECT_EQ(parse_repeat("p4m:5xFILL")->columns, 5);
    for (const char* bad : {"frieze:5xfill", "ring:fill", "p4m:fillx3", "p4m:0xfill", "p4m:fill4"}) {
        EXPECT_FALSE(parse_repeat(bad)) << bad;
    }
    EXPECT_ANY_THROW(draw(document, "svg", {{"repeat", "p4m:fill"}, {"step", "0.1mm"}, {"size", "A0"}}));
}

/// A frieze runs from edge to edge, and is as high as the page within its margins.
TEST(Repeat, AFriezeFillsItsRow) {
    const Document document = parse("hook.lsys", hook);
    for (const char* group : {"frieze", "frieze-p2mg", "frieze-p1m1"}) {
        SCOPED_TRACE(group);
        Box box;
        const OptionValues values = {{"repeat", std::string(group) + ":fill"}, {"size", "500x60mm"}};
        for (const Points& path : paths_of(draw(document, "svg", values))) {
            for (const glm::dvec2 point : path) box.add(point);
        }
        EXPECT_NEAR(box.low.x, 0, 30);
        EXPECT_NEAR(box.high.x, 500, 30);
        EXPECT_GE(box.low.y, 10 - close);
        EXPECT_LE(box.high.y, 50 + close);
        EXPECT_GT(box.high.y - box.low.y, 25);
    }
}

TEST(Repeat, CopiesInUnitsOfAnotherShapeAreReported) {
    const Document square = parse("square.lsys", "axiom: F+F+F+F\nangle increment: 90\n");
    const auto report = [&](const char* repeat) {
        return made_work(prints(), square, "svg", {{"repeat", repeat}}).remarks;
    };
    for (const char* repeat : {"p4m:3x4", "p4m:fill", "p6m:2x2"}) {
        EXPECT_TRUE(has(report(repeat), "; packed covers 86 %"));
    }
    for (const char* repeat : {"p1:3x4", "packed:3x4", "pmm:2x2", "p4:2x2", "frieze:3", "ring:5"}) {
        EXPECT_FALSE(has(report(repeat), "packed covers"));
    }
    const std::vector<glm::dvec2> unit = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    Repeat repeat = *parse_repeat("p1:1x1,gap=0");
    EXPECT_NEAR(covered_share(repeat, unit), 1.0, 1e-9);
    repeat.gap = 1;
    repeat.gap_is_in_steps = true;
    EXPECT_NEAR(covered_share(repeat, unit), 0.25, 1e-9);
}

/// Fills are cut, too; a stroke that leaves the area and returns becomes two.
TEST(Repeat, CropsExactly) {
    class Noted : public PathSink {
    public:
        void begin_stroke(glm::dvec2 start, const Pen&) override { strokes.push_back({start}); }
        void lines(std::span<const glm::dvec2> ends) override {
            strokes.back().insert(strokes.back().end(), ends.begin(), ends.end());
        }
        void curves(std::span<const glm::dvec2> controls) override { lines(controls.last(1)); }
        void change_pen(const Pen&) override {}
        void end_stroke(bool closed) override { is_closed = closed; }
        void polygon(std::span<const glm::dvec2> vertices, const Pen&) override {
            polygons.emplace_back(vertices.begin(), vertices.end());
        }
        void area(std::span<const glm::dvec2>, const Pen&) override { ++wholes; }
        void disc(glm::dvec2, double, const Pen&) override { ++wholes; }
        std::vector<Points> strokes, polygons;
        bool is_closed = false;
        int wholes = 0;
    } noted;
    CropSink crop(noted, {0, 0}, {10, 10}, {{2, 0}, {0, -2}, {0, 10}}, 0.001);  // steps 0 to 5
    const Points line = {{2, 1}, {8, 1}, {8, 4}, {1, 4}};
    crop.begin_stroke(line.front(), {});
    crop.lines(std::span(line).subspan(1));
    crop.end_stroke(false);
    ASSERT_EQ(noted.strokes.size(), 2u);
    EXPECT_NEAR(glm::length(noted.strokes[0].back() - glm::dvec2(5, 1)), 0, 1e-9);
    EXPECT_NEAR(glm::length(noted.strokes[1].front() - glm::dvec2(5, 4)), 0, 1e-9);
    // Out at the top and in again.
    noted.strokes.clear();
    crop.begin_stroke({1, 4}, {});
    crop.curves(Points{{1, 8}, {4, 8}, {4, 4}});
    crop.end_stroke(false);
    ASSERT_EQ(noted.strokes.size(), 2u);
    EXPECT_NEAR(noted.strokes[0].back().y, 5, 1e-9);
    EXPECT_NEAR(noted.strokes[1].front().y, 5, 1e-9);
    crop.polygon(Points{{4, 2}, {8, 2}, {8, 3}, {4, 3}}, {});
    ASSERT_EQ(noted.polygons.size(), 1u);
    for (const glm::dvec2 corner : noted.polygons[0]) EXPECT_LE(corner.x, 5 + 1e-9);
    crop.disc({2, 2}, 1, {});
    crop.disc({5, 2}, 1, {});
    crop.disc({9, 2}, 1, {});
    EXPECT_EQ(noted.wholes, 1);
    EXPECT_EQ(noted.polygons.size(), 2u);
}

TEST(Repeat, RefusesTooMuch) {
    const Document large = parse("large.lsys", "axiom: F\nF --> FFFFFFFFFF\nderivation length: 5\n");
    EXPECT_NO_THROW(draw(large, "svg", {{"repeat", "ring:3"}, {"budget", "1e6"}}));
    EXPECT_ANY_THROW(draw(large, "svg", {{"repeat", "ring:300"}, {"budget", "1e6"}}));
    try {
        draw(large, "svg", {{"repeat", "ring:300"}, {"budget", "1e6"}});
    } catch (const BudgetError& error) {
        EXPECT_TRUE(has(error.what(), "; the 300 copies of 'repeat' share the budget of 1000000 nodes"));
    }
    const Document solid = parse("solid.lsys", "axiom: F&F\n");
    EXPECT_THROW(draw(solid, "svg", {{"repeat", "ring:3"}}), SettingError);
    EXPECT_THROW(draw(large, "svg", {{"repeat", "ring:3"}, {"window", "0,0,1,1"}}), SettingError);
}

}  // namespace sikku::repeat_test
