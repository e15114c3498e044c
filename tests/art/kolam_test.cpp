#include "art/kolam/kolam.h"

#include "engine/geometry/spline.h"
#include "engine/geometry/turtle.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>

namespace sikku::kolam_test {

using reference::grammar_of;
using reference::Recorder;

using Points = std::vector<glm::dvec2>;

KolamExamination examined(const Grammar& grammar, bool spline) {
    KolamOptions options{.spline = spline};
    return examine_kolam(grammar, options);
}
std::string keys(const std::string& angle, const std::string& axiom) {
    return "angle increment: " + angle + "\naxiom: " + axiom + "\n";
}
KolamExamination examined(const std::string& angle, const std::string& axiom, bool spline = false) {
    return examined(grammar_of(keys(angle, axiom)), spline);
}
/// The same drawing from a grammar that has no lattice, as some other symbol of it might turn by very little.
KolamExamination examined_roughly(const std::string& angle, const std::string& axiom, bool spline = false) {
    return examined(grammar_of(keys(angle, axiom) + "Q --> +(0.0000123)\n"), spline);
}

struct Known {
    std::string name;
    Grammar grammar;
    bool spline;
};
Known known(const std::string& name, const std::string& steps = "") {
    const std::string text = contents(std::filesystem::path(SIKKU_SOURCE_DIR) / ("patterns/" + name + ".lsys"));
    std::vector<Setting> settings;
    if (!steps.empty()) settings.push_back({"-n", "derivation length", steps});
    return {name + " " + steps, grammar_of(text, settings), text.find("line: spline") != std::string::npos};
}
KolamExamination examined(const Known& pattern) {
    return examined(pattern.grammar, pattern.spline);
}
std::vector<Known> kolams() {
    std::vector<Known> list;
    for (const char* steps : {"0", "1", "2", "3", "4"}) list.push_back(known("kolams/snake-kolam", steps));
    for (const char* steps : {"1", "2", "3", "4", "5"}) list.push_back(known("kolams/anklets-of-krishna", steps));
    for (const char* steps : {"2", "3", "4"}) list.push_back(known("kolams/bag-of-candies", steps));
    for (const char* steps : {"3", "5", "7"}) list.push_back(known("kolams/mango-leaves", steps));
    return list;
}

/// What the turtle draws, by the road that prints take.
Recorder recorded(const Known& pattern, bool as_spline) {
    StrokeCensus census;
    Recorder recorder;
    SplineSink spline(recorder, census.closed);
    derive(pattern.grammar, *Turtle::drawing(pattern.grammar, census, pattern.spline), {.interpreted = true});
    PathSink& sink = as_spline ? static_cast<PathSink&>(spline) : recorder;
    derive(pattern.grammar, *Turtle::drawing(pattern.grammar, sink, pattern.spline), {.interpreted = true});
    return recorder;
}

/// The strokes as polygons, Béziers in 12 chords each.
std::vector<Points> polygons(const Known& pattern) {
    std::vector<Points> list;
    for (const reference::Line& stroke : recorded(pattern, pattern.spline).strokes) {
        Points& points = list.emplace_back();
        if (!pattern.spline) {
            points = stroke.points;
            continue;
        }
        for (std::size_t i = 0; i + 3 < stroke.points.size(); i += 3) {
            const glm::dvec2* p = &stroke.points[i];
            for (int k = 0; k < 12; ++k) {
                const double t = k / 12.0;
                const double s = 1 - t;
                points.push_back(s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3]);
            }
        }
        points.push_back(stroke.points.back());
    }
    return list;
}

/// Even-odd: is the number of lines right of the point odd? A slanted ray, which meets no corner.
bool is_inside(const std::vector<Points>& lines, glm::dvec2 point) {
    const glm::dvec2 along(1.0, 0.0123456789);
    const auto height = [&](glm::dvec2 q) { return (q.y - point.y) * along.x - (q.x - point.x) * along.y; };
    bool inside = false;
    for (const Points& line : lines) {
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const double a = height(line[i]);
            const double b = height(line[i + 1]);
            if ((a > 0) == (b > 0)) continue;
            const glm::dvec2 meeting = line[i] + a / (a - b) * (line[i + 1] - line[i]);
            if (meeting.x > point.x) inside = !inside;
        }
    }
    return inside;
}

// --- published facts ----------------------------------------------------------------------------------------------

TEST(Kolam, SnakeHasItsSegmentsAndMeetings) {
    const std::vector<std::uint64_t> meetings = {0, 4, 20, 84, 340};
    for (std::size_t n = 0; n < meetings.size(); ++n) {
        const KolamExamination k = examined(known("kolams/snake-kolam", std::to_string(n)));
        EXPECT_TRUE(k.is_exact);
        EXPECT_EQ(k.segments, ((std::uint64_t{1} << (2 * (n + 2))) - 4) / 3) << n;
        EXPECT_EQ(k.meetings, meetings[n]) << n;
        EXPECT_EQ(k.touchings, meetings[n]) << n;  // it turns back at each
        EXPECT_EQ(k.crossings, 0u) << n;
        EXPECT_EQ(k.lines, 1u) << n;
        EXPECT_EQ(k.dots.size(), k.segments / 4) << n;
        EXPECT_EQ(k.reused_edges, 0u) << n;
        EXPECT_TRUE(k.is_kolam()) << n;
        EXPECT_TRUE(k.remarks().empty()) << n;
    }
}

TEST(Kolam, AnkletsCrossWhereTheSnakeTurnsBack) {
    const std::vector<std::uint64_t> crossings = {0, 4, 20, 84, 340};
    for (std::size_t n = 0; n < crossings.size(); ++n) {
        const KolamExamination k = examined(known("kolams/anklets-of-krishna", std::to_string(n + 1)));
        EXPECT_TRUE(k.is_exact);
        EXPECT_EQ(k.segments, ((std::uint64_t{1} << (2 * (n + 2))) - 4) / 3) << n;
        EXPECT_EQ(k.meetings, crossings[n]) << n;
        EXPECT_EQ(k.crossings, crossings[n]) << n;
        EXPECT_EQ(k.skew + k.mid_crossings + k.touchings + k.multiple, 0u) << n;
        EXPECT_EQ(k.lines, 1u) << n;
        EXPECT_EQ(k.straight_lines, 1u) << n;
        EXPECT_EQ(k.dots.size(), k.segments / 4) << n;
        EXPECT_TRUE(k.is_kolam()) << n;
    }
}

/// The lines of light in a box of a x b dots (2a x 2b units, mirrors all around) that start in the middles of sides,
/// for a turtle whose steps are the diagonals of units.
std::string mirror_curves(int a, int b) {
    std::string word;
    std::set<std::tuple<int, int, int, int>> seen;
    for (int start = 1; start < 2 * a + 2 * b; start += 2) {
        int x = start < 2 * a ? start : 0;
        int y = start < 2 * a ? 0 : start - 2 * a;
        int dx = 1;
        int dy = 1;
        if (seen.count({x, y, dx, dy}) != 0) continue;
        word += "[f(" + std::to_string((x + y - 1) / 2) + ")+f(" + std::to_string((y - x + 1) / 2) + ")-";
        int heading = 0;
        while (seen.insert({x, y, dx, dy}).second) {
            const int wanted = dx > 0 ? (dy > 0 ? 0 : 3) : (dy > 0 ? 1 : 2);  // quarters to the right
            for (; heading != wanted; heading = (heading + 1) % 4) word += "+";
            word += "F";
            x += dx;
            y += dy;
            seen.insert({x, y, -dx, -dy});  // backwards it is the same line
            if (x == 0 || x == 2 * a) dx = -dx;
            if (y == 0 || y == 2 * b) dy = -dy;
        }
        word += "]";
    }
    return word;
}

TEST(Kolam, MirrorCurvesHaveAsManyLinesAsTheGreatestCommonDivisor) {  // Gerdes; Jablan
    for (int a = 1; a <= 7; ++a) {
        for (int b = 1; b <= 7; ++b) {
            const KolamExamination k = examined("90", mirror_curves(a, b));
            const std::string what = std::to_string(a) + " x " + std::to_string(b);
            EXPECT_EQ(k.lines, static_cast<std::uint64_t>(std::gcd(a, b))) << what;
            EXPECT_EQ(k.straight_lines, k.lines) << what;
            EXPECT_EQ(k.open_lines, 0u) << what;
            EXPECT_EQ(k.dots.size(), static_cast<std::size_t>(a * b)) << what;
            EXPECT_EQ(k.crossings, static_cast<std::uint64_t>(a * (b - 1) + b * (a - 1))) << what;
            EXPECT_EQ(k.skew + k.touchings + k.multiple, 0u) << what;
            EXPECT_EQ(k.symmetry.name(), a == b ? "D4" : "D2") << what;
            EXPECT_TRUE(k.is_kolam()) << what;
            EXPECT_EQ(k.remarks().empty(), k.lines == 1) << what;
        }
    }
}

TEST(Kolam, CandiesAndMangoes) {
    const KolamExamination candies = examined(known("kolams/bag-of-candies", "2"));
    EXPECT_EQ(candies.lines, 1u);
    EXPECT_EQ(candies.crossings, 40u);
    EXPECT_EQ(candies.dots.size(), 33u);  // 1 + 4 + 4 x 7; the squares between have none
    EXPECT_EQ(candies.faces, 41u);
    EXPECT_EQ(candies.symmetry.name(), "D4");
    const KolamExamination mangoes = examined(known("kolams/mango-leaves", "7"));
    EXPECT_EQ(mangoes.segments, 532u);
    EXPECT_EQ(mangoes.dots.size(), 133u);  // a leaf has four sides
    EXPECT_EQ(mangoes.symmetry.name(), "D2");
    EXPECT_TRUE(mangoes.is_kolam());
    EXPECT_EQ(mangoes.remarks().size(), 3u);
}

// --- by another method --------------------------------------------------------------------------------------------

TEST(Kolam, DotsLieWithinTheLineAndOneInEachFace) {
    for (const Known& pattern : kolams()) {
        const KolamExamination k = examined(pattern);
        EXPECT_EQ(k.faces, k.edges - k.vertices + 1 + k.components - 1) << pattern.name;
        const std::vector<Points> lines = polygons(pattern);
        for (const KolamDot& dot : k.dots) {
            EXPECT_TRUE(dot.is_enclosed) << pattern.name;
            EXPECT_TRUE(is_inside(lines, dot.at)) << pattern.name << ": " << dot.at.x << ' ' << dot.at.y;
        }
        EXPECT_FALSE(is_inside(lines, k.centre + glm::dvec2(1e4, 0)));
        for (std::size_t i = 1; i < k.dots.size(); ++i) {  // as far apart as neighbours are
            const glm::dvec2 gap = k.dots[i].at - k.dots[i - 1].at;
            EXPECT_GT(std::hypot(gap.x, gap.y), 0.49) << pattern.name;
        }
    }
}

/// Straight pieces in a form that does not depend on where they begin or how they are cut, or passes of a spline's
/// control points, turned by `degrees` and mirrored about the centre, rounded.
std::multiset<std::vector<long>> shape(const Known& pattern, glm::dvec2 centre, double degrees, bool mirrored) {
    std::multiset<std::vector<long>> set;
    const double angle = degrees * std::numbers::pi / 180;
    const auto moved = [&](glm::dvec2 point) {
        point -= centre;
        if (mirrored) point.y = -point.y;
        return std::pair(std::lround(1e4 * (std::cos(angle) * point.x - std::sin(angle) * point.y)),
                         std::lround(1e4 * (std::sin(angle) * point.x + std::cos(angle) * point.y)));
    };
    for (const reference::Line& stroke : recorded(pattern, false).strokes) {
        const std::size_t count = stroke.points.size() - 1;
        for (std::size_t i = 0; i < count; ++i) {
            auto a = moved(stroke.points[i]);
            auto b = moved(stroke.points[pattern.spline ? (i + 2) % count : i + 1]);
            if (b < a) std::swap(a, b);
            std::vector<long> element = {a.first, a.second, b.first, b.second};
            if (pattern.spline) {
                const auto middle = moved(stroke.points[i + 1]);
                element.insert(element.end(), {middle.first, middle.second});
            }
            set.insert(std::move(element));
        }
    }
    return set;
}

TEST(Kolam, SymmetryIsFoundByTurningTheDrawing) {
    std::vector<Known> patterns = kolams();
    for (const char* name : {"tilings/hexagonal-tiling", "curves/koch-island", "curves/quadratic-snowflake"}) {
        patterns.push_back(known(name, "2"));
    }
    for (const char* name : {"kooja-kolam", "mountain-kolam", "scissors"}) {
        patterns.push_back(known(std::string("kolams/") + name));
    }
    for (const Known& pattern : patterns) {
        const KolamExamination k = examined(pattern);
        // The middle of the box: another way to the centre, if there is more than one mirror or rotation.
        const auto as_it_is = shape(pattern, k.centre, 0, false);
        std::uint32_t rotations = 0;
        std::uint32_t mirrors = 0;
        for (int degrees = 0; degrees < 360; degrees += 15) {
            const auto same = [&](bool mirrored) {
                // Edges that are drawn twice count once.
                const auto turned = shape(pattern, k.centre, degrees, mirrored);
                const auto once = [](const auto& set) { return std::set<std::vector<long>>(set.begin(), set.end()); };
                return once(turned) == once(as_it_is);
            };
            rotations += same(false) ? 1 : 0;
            mirrors += same(true) ? 1 : 0;
        }
        EXPECT_EQ(k.symmetry.rotations, rotations) << pattern.name;
        EXPECT_EQ(k.symmetry.mirrors, mirrors) << pattern.name;
    }
}

void expect_same(const KolamExamination& exact, const KolamExamination& rough, const std::string& what) {
    EXPECT_TRUE(exact.is_exact) << what;
    EXPECT_FALSE(rough.is_exact) << what;
    EXPECT_EQ(rough.tolerance, 1e-6);
    const auto facts = [](const KolamExamination& k) {
        return std::vector<std::uint64_t>{
            k.segments,    k.strokes,       k.lines,     k.open_lines,   k.straight_lines,     k.vertices,
            k.edges,       k.components,    k.faces,     k.reused_edges, k.meetings,           k.crossings,
            k.skew,        k.mid_crossings, k.touchings, k.multiple,     k.symmetry.rotations, k.symmetry.mirrors,
            k.dots.size(), k.loose_dots()};
    };
    EXPECT_EQ(facts(exact), facts(rough)) << what;
    if (exact.dots.size() != rough.dots.size()) return;
    for (std::size_t i = 0; i < exact.dots.size(); ++i) {
        EXPECT_NEAR(exact.dots[i].at.x, rough.dots[i].at.x, 1e-5) << what;
        EXPECT_NEAR(exact.dots[i].at.y, rough.dots[i].at.y, 1e-5) << what;
    }
}

std::string random_word(reference::Dice& dice, int length) {
    std::string word;
    int depth = 0;
    for (int i = 0; i < length; ++i) {
        const std::uint64_t roll = dice.below(20);
        if (roll < 11) word += 'F';
        if (roll == 11) word += "F(2)";
        if (roll == 12) word += 'f';
        if (roll >= 13 && roll < 16) word += '+';
        if (roll >= 16 && roll < 18) word += '-';
        if (roll == 18 && depth < 5) {
            word += '[';
            ++depth;
        }
        if (roll == 19 && depth > 0) {
            word += ']';
            --depth;
        }
    }
    return "F" + word + std::string(static_cast<std::size_t>(depth), ']');
}

TEST(Kolam, ExactAndRoughAgreeOnRandomWalks) {
    for (const char* angle : {"90", "60", "120", "45", "30", "72", "36", "24", "20"}) {
        for (unsigned seed = 0; seed < 60; ++seed) {
            reference::Dice dice(seed);
            const std::string word = random_word(dice, 10 + static_cast<int>(seed) * 2);
            const bool spline = seed % 3 == 0;
            expect_same(examined(angle, word, spline), examined_roughly(angle, word, spline),
                        std::string(angle) + ": " + word);
        }
    }
}

/// Points where the segments of a drawing begin, end or meet, and the pieces between them, all pairs compared, in
/// doubles.
std::pair<std::size_t, std::size_t> vertices_and_edges(const std::vector<Points>& lines) {
    const auto rounded = [](glm::dvec2 point) {
        return std::pair(std::lround(point.x * 1e5), std::lround(point.y * 1e5));
    };
    std::vector<std::pair<glm::dvec2, glm::dvec2>> segments;
    for (const Points& line : lines) {
        for (std::size_t i = 0; i + 1 < line.size(); ++i) segments.emplace_back(line[i], line[i + 1]);
    }
    std::set<std::pair<long, long>> vertices;
    std::set<std::set<std::pair<long, long>>> edges;
    for (const auto& [a, b] : segments) {
        const glm::dvec2 along = b - a;
        const double length = std::hypot(along.x, along.y);
        std::vector<double> cuts = {0.0, 1.0};
        const auto cut = [&](double t) {
            if (t > 1e-7 && t < 1 - 1e-7) cuts.push_back(t);
        };
        for (const auto& [c, d] : segments) {
            const glm::dvec2 other = d - c;
            const double whole = along.x * other.y - along.y * other.x;
            if (std::fabs(whole) < 1e-7) {
                for (const glm::dvec2 end : {c, d}) {
                    const glm::dvec2 way = end - a;
                    if (std::fabs(along.x * way.y - along.y * way.x) > 1e-7) continue;
                    cut((along.x * way.x + along.y * way.y) / (length * length));
                }
                continue;
            }
            const glm::dvec2 way = c - a;
            const double s = (way.x * along.y - way.y * along.x) / whole;
            if (s > -1e-7 && s < 1 + 1e-7) cut((way.x * other.y - way.y * other.x) / whole);
        }
        std::sort(cuts.begin(), cuts.end());
        std::pair<long, long> last = rounded(a);
        for (const double t : cuts) {
            // Rounding may fall either way: the nearest vertex that is there already is meant.
            std::pair<long, long> place = rounded(a + t * along);
            for (long x = -1; x <= 1; ++x) {
                for (long y = -1; y <= 1; ++y) {
                    if (vertices.count({place.first + x, place.second + y}) == 0) continue;
                    place = {place.first + x, place.second + y};
                    x = y = 2;
                }
            }
            vertices.insert(place);
            if (t > 0 && place != last) edges.insert({last, place});
            last = place;
        }
    }
    return {vertices.size(), edges.size()};
}

TEST(Kolam, TheGraphIsThatOfComparingAllPairs) {
    for (const char* angle : {"90", "60", "45", "30", "72", "40"}) {
        for (unsigned seed = 100; seed < 125; ++seed) {
            reference::Dice dice(seed);
            const std::string word = random_word(dice, 80);
            const Known pattern{word, grammar_of(keys(angle, word)), false};
            const KolamExamination k = examined(pattern);
            const auto [vertices, edges] = vertices_and_edges(polygons(pattern));
            EXPECT_EQ(k.vertices, vertices) << angle << ": " << word;
            EXPECT_EQ(k.edges, edges) << angle << ": " << word;
            EXPECT_EQ(k.faces + k.vertices, k.edges + k.components) << angle << ": " << word;
        }
    }
}

TEST(Kolam, DotsOfRandomClosedWalksAreWithinThem) {
    for (unsigned seed = 0; seed < 80; ++seed) {
        reference::Dice dice(seed);
        // A walk four times over, with a quarter turn left over each time, closes.
        std::string part = "FF";
        int turns = 0;
        for (int i = 0; i < 12; ++i) {
            const bool right = dice.below(2) == 0;
            turns += right ? 1 : -1;
            part += right ? "+F" : "-F";
        }
        for (; (turns % 4 + 4) % 4 != 1; ++turns) part += "+";
        const Known pattern{part, grammar_of(keys("90", part + part + part + part)), false};
        const KolamExamination k = examined(pattern);
        EXPECT_EQ(k.open_lines, 0u) << part;
        EXPECT_EQ(k.symmetry.rotations % 4, 0u) << part;
        for (const KolamDot& dot : k.dots) EXPECT_TRUE(is_inside(polygons(pattern), dot.at)) << part;
    }
}

// --- what is no kolam, and why ------------------------------------------------------------------------------------

bool names(const std::vector<std::string>& list, const std::string& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

TEST(Kolam, SaysWhatBreaksTheRules) {
    const KolamExamination island = examined(known("curves/koch-island"));
    EXPECT_EQ(island.lines, 1u);
    EXPECT_EQ(island.dots.size(), 1u);
    EXPECT_TRUE(names(island.faults(), "1 of 1 dot is not encircled"));
    EXPECT_EQ(island.symmetry.name(), "C4");

    const KolamExamination open = examined("90", "F+F+F+FF");
    EXPECT_EQ(open.faults(), (std::vector<std::string>{"the line is open", "no closed line goes around a dot"}));

    const KolamExamination tiling = examined(known("tilings/hexagonal-tiling"));
    EXPECT_TRUE(names(tiling.faults(), "135 edges are drawn more than once"));

    const KolamExamination plant = examined(known("plants/plant-b"));
    EXPECT_TRUE(names(plant.faults(), "open"));

    const KolamExamination twice = examined("90", "F+F+F+F+F+F+F+F");
    EXPECT_EQ(twice.reused_edges, 4u);
    EXPECT_EQ(twice.faults().front(), "4 edges are drawn more than once");
    EXPECT_TRUE(twice.dots.empty());  // around twice is outside by the even-odd rule

    const KolamExamination part = examined("90", "F(3)++F");  // back over a third of it
    EXPECT_EQ(part.reused_edges, 1u);
    EXPECT_EQ(part.edges, 2u);
}

TEST(Kolam, CrossingsAreLookedAt) {
    // A bow of two triangles: its sides cross at 60 degrees, where the turtle pauses.
    const KolamExamination bow = examined("60", "FF++F++FF--F");
    EXPECT_EQ(bow.crossings, 1u);
    EXPECT_EQ(bow.skew, 1u);
    EXPECT_EQ(bow.mid_crossings, 0u);
    EXPECT_EQ(bow.sixty, 1u);
    EXPECT_TRUE(bow.remarks().empty());  // as on interlaced dots
    EXPECT_EQ(examined("45", "FF+++F(1.4142135623730951)+++FF---F(1.4142135623730951)").sixty, 0u);
    EXPECT_EQ(bow.dots.size(), 2u);
    EXPECT_TRUE(bow.is_kolam());
    EXPECT_EQ(bow.symmetry.name(), "D2");
    // The same where it does not pause.
    const KolamExamination mid = examined("60", "F(2)++F++F(2)--F");
    EXPECT_EQ(mid.crossings, 1u);
    EXPECT_EQ(mid.mid_crossings, 1u);
    EXPECT_EQ(mid.skew, 1u);
    EXPECT_EQ(mid.symmetry.name(), "D2");
    EXPECT_EQ(mid.dots.size(), 2u);

    // Three diagonals of a hexagon and every other side, through one point, whether the turtle pauses there or not.
    for (const char* word : {"FF++F++FF++F++FF++F", "F(2)++F++F(2)++F++F(2)++F"}) {
        const KolamExamination k = examined("60", word);
        EXPECT_EQ(k.multiple, 1u) << word;
        EXPECT_EQ(k.meetings, 1u) << word;
        EXPECT_EQ(k.crossings, 0u) << word;
        EXPECT_EQ(k.vertices, 7u) << word;
        EXPECT_EQ(k.dots.size(), 3u) << word;
        EXPECT_EQ(k.symmetry.name(), "D3") << word;
        EXPECT_TRUE(k.is_kolam()) << word;
        EXPECT_EQ(k.remarks(), (std::vector<std::string>{"1 point is visited more than twice"})) << word;
    }
    const KolamExamination star = examined("60", "[F(2)][f+F][f-F][f++F][f--F]");
    EXPECT_EQ(star.lines, 3u);
    EXPECT_EQ(star.multiple, 1u);
    EXPECT_EQ(star.open_lines, 3u);
    EXPECT_TRUE(names(star.remarks(), "1 point is visited more than twice"));
    EXPECT_EQ(star.symmetry.name(), "D6");
    const KolamExamination inside = examined("60", "[F(2)][f+f(-1)F(2)][f++f(-1)F(2)]");  // nowhere does it pause
    EXPECT_EQ(inside.multiple, 1u);
    EXPECT_EQ(inside.vertices, 7u);
    EXPECT_EQ(inside.symmetry.name(), "D6");
    EXPECT_TRUE(inside.is_exact);

    const KolamExamination square = examined("90", "F(2)+F+F+F(2)");
    EXPECT_EQ(square.crossings, 1u);
    EXPECT_EQ(square.skew, 0u);
    EXPECT_EQ(square.open_lines, 1u);
}

TEST(Kolam, StrokesThatMeetEndToEndAreOneLine) {
    const KolamExamination k = examined("90", "[F+F][+F-F]");
    EXPECT_EQ(k.strokes, 2u);
    EXPECT_EQ(k.lines, 1u);
    EXPECT_EQ(k.open_lines, 0u);
    EXPECT_TRUE(k.is_kolam());
    EXPECT_EQ(k.symmetry.name(), "D4");
    // Two squares on one diagonal: at the corner each stroke goes on straight.
    const KolamExamination squares = examined("90", "[F+F][+F-F][--F+F][-F-F]");
    EXPECT_EQ(squares.dots.size(), 2u);
    EXPECT_EQ(squares.lines, 1u);
    EXPECT_EQ(squares.open_lines, 0u);
}

TEST(Kolam, LoopsWithinLoops) {
    // A square in a square in a square: the rings are inside, the gap between them is not.
    const KolamExamination k = examined("90", "F(5)+F(5)+F(5)+F(5)+f+f-F(3)+F(3)+F(3)+F(3)+f+f-F+F+F+F");
    EXPECT_EQ(k.components, 3u);
    EXPECT_EQ(k.faces, 3u);
    ASSERT_EQ(k.dots.size(), 2u);
    EXPECT_EQ(k.loose_dots(), 1u);  // that of the outer ring
    for (const KolamDot& dot : k.dots) {
        const double out = std::max(std::fabs(dot.at.x - 2.5), std::fabs(dot.at.y - 2.5));
        EXPECT_TRUE(out < 0.5 || (out > 1.5 && out < 2.5)) << dot.at.x << ' ' << dot.at.y;
        EXPECT_TRUE(dot.is_enclosed);
    }
    EXPECT_EQ(k.symmetry.name(), "D4");
}

TEST(Kolam, LinesThatAreImagesOfEachOtherHaveOneNumber) {
    // A square in the middle and two smaller ones beside it, of which one is the mirror image of the other.
    const std::string axiom = "F(4)+F(4)+F(4)+F(4)[f(1)-f(2)F-F-F-F-][f(1)+f(6)F+F+F+F+]";
    for (const KolamExamination& k : {examined("90", axiom), examined_roughly("90", axiom)}) {
        ASSERT_EQ(k.lines, 3u);
        EXPECT_EQ(k.symmetry.name(), "D1");
        EXPECT_EQ(k.orbit_of_line, (std::vector<std::uint32_t>{0, 1, 1}));
    }
    const KolamExamination alone = examined("90", "F(4)+F(4)+F(4)+F(4)[f(1)-f(2)F-F-F-F-]");
    EXPECT_EQ(alone.orbit_of_line, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(examined("90", "F+F+F+F").orbit_of_line, std::vector<std::uint32_t>{0});
}

TEST(Kolam, SymmetryDoesNotDependOnHowThePieceIsDrawn) {
    EXPECT_EQ(examined("90", "F(2)+FF+F(2)+F(2)").symmetry.name(), "D4");
    EXPECT_EQ(examined("90", "FF+FF+FF+FF+F(2)").symmetry.name(), "D4");
    EXPECT_EQ(examined("90", "[F(3)][f+F][f-F]").symmetry.name(), "D1");
    EXPECT_EQ(examined("90", "FF+F+FF+F").symmetry.name(), "D2");
    EXPECT_EQ(examined("90", "[F+F(2)][++F+F(2)]").symmetry.name(), "C2");
    EXPECT_EQ(examined("90", "F(3)+F+F(2)").symmetry.name(), "C1");
    EXPECT_EQ(examined("72", "F+F+F+F+F").symmetry.name(), "D5");
    EXPECT_EQ(examined("144", "F+F+F+F+F").symmetry.name(), "D5");
    EXPECT_EQ(examined("45", "F+F+F+F+F+F+F+F").symmetry.name(), "D8");
    EXPECT_EQ(examined("24", "F+F+F+F+F+F+F+F+F+F+F+F+F+F+F").symmetry.name(), "D15");
    EXPECT_EQ(examined("90", "F").symmetry.name(), "D2");
}

// --- without a lattice, and at the limits of one ------------------------------------------------------------------

TEST(Kolam, OtherAnglesAreExaminedWithATolerance) {
    // 14 of 360/14 close; 25.7 degrees is a little less.
    const std::string ring = "F+F+F+F+F+F+F+F+F+F+F+F+F+F";
    const KolamExamination closed = examined("360/14", ring);
    EXPECT_TRUE(closed.is_exact);
    EXPECT_TRUE(closed.is_kolam());
    EXPECT_EQ(closed.symmetry.name(), "D14");
    const KolamExamination open = examined("25.7", ring);
    EXPECT_FALSE(open.is_exact);
    EXPECT_EQ(open.tolerance, 1e-6);
    EXPECT_EQ(open.open_lines, 1u);
    EXPECT_FALSE(open.is_kolam());
    EXPECT_EQ(open.symmetry.name(), "D1");
    const KolamExamination degrees = examined("1", [] {
        std::string word;
        for (int i = 0; i < 360; ++i) word += "F+";
        return word;
    }());
    EXPECT_FALSE(degrees.is_exact);
    EXPECT_TRUE(degrees.is_kolam());
    EXPECT_EQ(degrees.symmetry.name(), "D360");
    const KolamExamination radian = examined("57.29577951308232", "F+F+F+F+F+F+F+F");
    EXPECT_FALSE(radian.is_exact);
    EXPECT_GT(radian.crossings, 0u);
    EXPECT_EQ(radian.symmetry.name(), "D1");
    EXPECT_TRUE(names(radian.faults(), "the line is open"));
}

/// To where phi F(n) - F(n+1) = -(-1 / phi)^n on the x axis, and a bar through it along `turns` x 36 degrees.
std::string bar(int n, int turns) {
    std::int64_t small = 0;
    std::int64_t large = 1;
    for (int i = 0; i < n; ++i) small = std::exchange(large, small + large);
    const std::string a = std::to_string(small);
    return "[-f(" + a + ")++f(" + a + ")-f(-" + std::to_string(large) + ")" +
           std::string(static_cast<std::size_t>(turns), '-') + "f(-1)F(2)]";
}

TEST(Kolam, SeesTheSmallestGapsThatALatticeHas) {
    // Bars that cross a ledge at its very end, or miss it: by 1e-12 steps, where doubles of the coordinates tell
    // thousandths.
    for (int n = 1; n <= 56; ++n) {
        const KolamExamination k = examined(grammar_of(keys("36", "[F]" + bar(n, 2)) + "heading: 0\n"), false);
        EXPECT_TRUE(k.is_exact);
        EXPECT_EQ(k.crossings, n % 2 == 0 ? 0u : 1u) << n;
        EXPECT_EQ(k.mid_crossings, k.crossings) << n;
        EXPECT_EQ(k.components, n % 2 == 0 ? 2u : 1u) << n;
        EXPECT_EQ(k.vertices, n % 2 == 0 ? 4u : 5u) << n;
    }
    const KolamExamination touching = examined(grammar_of(keys("36", "[F][--f(-1)F(2)]") + "heading: 0\n"), false);
    EXPECT_EQ(touching.crossings, 0u);
    EXPECT_EQ(touching.components, 1u);
    EXPECT_EQ(touching.vertices, 4u);
    // Three crossings, and a triangle between them that is no larger.
    for (int n = 1; n <= 54; n += 2) {
        const KolamExamination k =
            examined(grammar_of(keys("36", "[F]" + bar(n, 2) + bar(n + 2, 3)) + "heading: 0\n"), false);
        EXPECT_EQ(k.crossings, 3u) << n;
        EXPECT_EQ(k.vertices, 9u) << n;
        EXPECT_EQ(k.faces, 1u) << n;
    }
}

TEST(Kolam, BadInput) {
    EXPECT_THROW(examined("90", "f+f"), std::runtime_error);
    EXPECT_THROW(examined("90", "F(0)"), std::runtime_error);
    EXPECT_THROW(examined("90", "F]"), WordError);
    KolamOptions options{.budget = 1000};
    EXPECT_THROW(examine_kolam(known("kolams/snake-kolam", "12").grammar, options), BudgetError);
    EXPECT_THROW(examine_kolam(known("kolams/anklets-of-krishna", "4").grammar, {true, 3000, {}}), BudgetError);
    EXPECT_NO_THROW(examine_kolam(known("kolams/anklets-of-krishna", "4").grammar, {true, 30000, {}}));
    // A comb over a comb: more crossings than the budget has room for.
    std::string comb;
    for (int i = 0; i < 200; ++i) comb += "F(400)+f+F(400)-f-";
    const Grammar combs = grammar_of(keys("90", "[" + comb + "][ff+ff" + comb + "]"));
    EXPECT_THROW(examine_kolam(combs, {false, 50'000, {}}), BudgetError);
    // Far away and tiny.
    EXPECT_NO_THROW(examined("90", "Ff(1000000000000)F"));
    EXPECT_NO_THROW(examined("45", "F(0.000001)f(1000000)F(1000000)+F(0.000001)"));
    EXPECT_NO_THROW(examined("90", "F(1099511627775)+F(1)+F(1099511627775)"));
    EXPECT_THROW(examined("90", "F(1099511627776)"), std::runtime_error);  // too far for a tolerance
    // A stop from outside.
    KolamOptions stopped;
    stopped.watch = [](std::uint64_t) { throw std::runtime_error("stopped"); };
    EXPECT_THROW(examine_kolam(known("kolams/snake-kolam", "3").grammar, stopped), std::runtime_error);
}

}  // namespace sikku::kolam_test
