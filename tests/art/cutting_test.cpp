// Cutting sheets: densities from the literature, overlaps by a second algorithm, sums, limits.
#include "art/cutting/cutting_sheets.h"
#include "art/cutting/no_fit.h"
#include "art/cutting/piece_nest.h"
#include "art/cutting/piece_rows.h"
#include "art/cutting/slide.h"
#include "art/drawing/ink_shape.h"
#include "engine/geometry/simple_polygon.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku::cutting_test {

using Polygon = std::vector<glm::dvec2>;

std::vector<CutKind> kinds_of(const std::string& tiling, const std::string& steps, double step, bool grain = false) {
    return cut_list(
        examine_tiling(
            reference::grammar_of(contents(bundled("tilings/" + tiling)), {{"-n", "derivation length", steps}}), {}),
        step, grain);
}

Polygon regular(int corners, double radius) {
    Polygon polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return polygon;
}

Polygon placed(const Polygon& polygon, const PieceCopy& copy) {
    Polygon result = turned(polygon, copy.turn);
    for (glm::dvec2& corner : result) corner += copy.at;
    return result;
}

/// Length of a horizontal line that lies in both polygons, at some height: by intervals between crossings.
double common_width(const Polygon& a, const Polygon& b, double y) {
    const auto crossings = [&](const Polygon& polygon) {
        std::vector<double> found;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec2 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
            if ((from.y > y) != (to.y > y))
                found.push_back(from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y));
        }
        std::sort(found.begin(), found.end());
        return found;
    };
    const std::vector<double> first = crossings(a), second = crossings(b);
    double width = 0;
    for (std::size_t i = 0; i + 1 < first.size(); i += 2) {
        for (std::size_t k = 0; k + 1 < second.size(); k += 2) {
            width += std::max(0.0, std::min(first[i + 1], second[k + 1]) - std::max(first[i], second[k]));
        }
    }
    return width;
}

/// The largest width in common of any two polygons, on lines at many heights.
double worst_overlap(const std::vector<Polygon>& polygons) {
    double worst = 0;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const Box a = box_of(polygons[i]);
        for (std::size_t k = i + 1; k < polygons.size(); ++k) {
            const Box b = box_of(polygons[k]);
            if (b.low.x > a.high.x || a.low.x > b.high.x) continue;
            const double low = std::max(a.low.y, b.low.y), high = std::min(a.high.y, b.high.y);
            for (int line = 0; line < 40 && low + 1e-6 < high; ++line) {
                // Avoids horizontal sides, which are at simple fractions of the height.
                const double y = low + (high - low) * (line + 0.3183) / 40;
                worst = std::max(worst, common_width(polygons[i], polygons[k], y));
            }
        }
    }
    return worst;
}

std::vector<Polygon> laid(const Polygon& piece, const LaidPieces& pieces) {
    std::vector<Polygon> polygons;
    for (const PieceCopy& copy : pieces.copies) polygons.push_back(placed(piece, copy));
    return polygons;
}

double share(const Polygon& piece, double side) {
    const Box area{{0, 0}, {side, side}};
    const LaidPieces pieces = PieceRows(piece, false, area, {}).fill(area, 1'000'000);
    return static_cast<double>(pieces.copies.size()) * polygon_area(piece) / (side * side);
}

TEST(PieceRows, ReachTheDensitiesOfTheLiterature) {
    // Tiles fill the plane, except at the border of a sheet 100 pieces wide.
    for (const Polygon& piece :
         {regular(3, 1), regular(4, 1), regular(6, 1), Polygon{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}) {
        EXPECT_GT(share(piece, 200), 0.97);
        EXPECT_LE(share(piece, 200), 1 + 1e-9);
    }
    // Kuperberg & Kuperberg 1990: (5 - sqrt 5) / 3 is the density of the best double lattice of regular pentagons.
    const double best = (5 - std::sqrt(5.0)) / 3;
    EXPECT_GT(share(regular(5, 1), 400), best - 0.01);
    EXPECT_LE(share(regular(5, 1), 400), best);
    // A hat is eight of nine kites of its lattice.
    EXPECT_GT(share(kinds_of("hat", "1", 1).front().corners, 600), 8.0 / 9 - 0.02);
}

TEST(PieceRows, PiecesNeitherOverlapNorLeaveTheirArea) {
    const Box area{{3, 5}, {83, 115}};
    for (const std::string tiling : {"hat", "chair", "spectre", "sphinx", "penrose-rhombs", "penrose-kite-dart",
                                     "pinwheel", "l-tetromino", "half-hex", "p-pentomino", "equithirds"}) {
        for (const CutKind& kind : kinds_of(tiling, "2", 4)) {
            for (const double allowance : {0.0, 1.0}) {
                const Polygon piece = offset_outline(kind.corners, allowance);
                for (const bool grain : {false, true}) {
                    const LaidPieces pieces = PieceRows(piece, grain, area, {}).fill(area, 60);
                    ASSERT_FALSE(pieces.copies.empty()) << tiling;
                    const std::vector<Polygon> polygons = laid(piece, pieces);
                    EXPECT_LT(worst_overlap(polygons), 1e-5) << tiling << ' ' << kind.name << ' ' << allowance;
                    for (const Polygon& polygon : polygons) {
                        const Box box = box_of(polygon);
                        EXPECT_TRUE(box.low.x > area.low.x - 1e-6 && box.low.y > area.low.y - 1e-6);
                        EXPECT_TRUE(box.high.x < area.high.x + 1e-6 && box.high.y < area.high.y + 1e-6);
                        // What is left is free.
                        EXPECT_GE(box.low.y, pieces.below.high.y - 1e-6);
                        EXPECT_FALSE(!pieces.beside.empty() && box.high.x > pieces.beside.low.x + 1e-6 &&
                                     box.low.y < pieces.beside.high.y - 1e-6)
                            << tiling;
                    }
                    for (const PieceCopy& copy : pieces.copies) {
                        EXPECT_TRUE(!grain || std::fabs(std::sin(copy.turn)) < 1e-12);
                    }
                }
            }
        }
    }
}

/// Stops work that polls its monitor more often than a given number of times, once in 4,096 steps.
struct Patience {
    int polls = 0;
    Monitor monitor() {
        return Monitor([](void* patience) { return ++static_cast<Patience*>(patience)->polls > 500; }, nullptr, this);
    }
};

TEST(PieceRows, NeedlesTakeAsLittleAsOtherPieces) {
    const Box area{{0, 0}, {400, 280}};
    for (const double length : {390.0, 9e8}) {
        for (const double ratio : {1e3, length < 1000 ? 1e6 : 1e9}) {
            const double width = length / ratio;
            for (const Polygon& needle :
                 {Polygon{{0, 0}, {width, 0}, {width / 3, length}},
                  Polygon{{0, 0}, {length, 0}, {length, width}, {0, width}},
                  Polygon{{0, 0}, {length / 2, length / 2}, {length / 2, length / 2 + width}}}) {
                Patience patience;
                const LaidPieces pieces = PieceRows(needle, false, area, patience.monitor()).fill(area, 20);
                EXPECT_EQ(pieces.copies.size(), length < 1000 ? 20 : 0) << length << ' ' << ratio;
                const std::vector<Polygon> polygons = laid(needle, pieces);
                for (const Polygon& polygon : polygons) {
                    const Box box = box_of(polygon);
                    EXPECT_TRUE(box.low.x > area.low.x - 1e-6 && box.low.y > area.low.y - 1e-6);
                    EXPECT_TRUE(box.high.x < area.high.x + 1e-6 && box.high.y < area.high.y + 1e-6);
                }
                if (ratio <= 1e3) {
                    EXPECT_LT(worst_overlap(polygons), 1e-5) << length << ' ' << ratio;
                }
            }
        }
    }
}

TEST(Profile, SlidesUntilOutlinesTouch) {
    const Polygon notched = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}};
    const Polygon bar = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
    EXPECT_NEAR(Profile(notched, 0).slide(Profile(bar, 0), 1), 1, 1e-12);
    EXPECT_NEAR(Profile(notched, 0).slide(Profile(bar, 0), 0.5), 3, 1e-12);
    EXPECT_EQ(Profile(notched, 0).slide(Profile(bar, 0), 3), -std::numeric_limits<double>::infinity());
    EXPECT_NEAR(Profile(notched, 1).slide(Profile(bar, 1), 0), 3, 1e-12);
    const Polygon wedge = {{0, 0}, {2, 0}, {0, 1}};
    const Profile flipped = Profile(wedge, 0).turned();
    EXPECT_NEAR(Profile(wedge, 0).slide(flipped, 1), 2, 1e-12);
}

/// A polygon around the origin that does not cross itself.
Polygon star(std::mt19937& random, int corners) {
    std::uniform_real_distribution<double> radius(0.3, 1), shift(0.1, 0.9);
    Polygon polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * (i + shift(random)) / corners;
        polygon.push_back(radius(random) * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return polygon;
}

/// True if sides cross, or a corner lies within the other polygon.
bool overlap(const Polygon& a, const Polygon& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t k = 0; k < b.size(); ++k) {
            const glm::dvec2 p = a[i], q = a[(i + 1) % a.size()], r = b[k], s = b[(k + 1) % b.size()];
            if (side_of(p, q, r) * side_of(p, q, s) < 0 && side_of(r, s, p) * side_of(r, s, q) < 0) return true;
        }
    }
    return contains(a, b.front()) || contains(b, a.front());
}

TEST(NoFit, AgreesWithPolygonsThatCross) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-2.2, 2.2);
    for (int round = 0; round < 40; ++round) {
        const Polygon fixed = star(random, 3 + round % 11), moved = star(random, 3 + round % 7);
        const auto parts = convex_parts(fixed), moved_parts = convex_parts(moved);
        double area = 0;
        for (const Polygon& part : parts) {
            area += polygon_area(part);
            for (std::size_t i = 0; i < part.size(); ++i) {
                EXPECT_GE(side_of(part[i], part[(i + 1) % part.size()], part[(i + 2) % part.size()]), 0);
            }
        }
        EXPECT_NEAR(area, polygon_area(fixed), 1e-9);
        const NoFit no_fit(parts, moved_parts);
        for (int i = 0; i < 500; ++i) {
            const glm::dvec2 at(place(random), place(random));
            EXPECT_EQ(no_fit.overlaps(at), overlap(fixed, placed(moved, {0, at}))) << round;
        }
        // The border separates places that overlap from free ones.
        EXPECT_FALSE(no_fit.sides().empty());
        for (const NoFit::Side& side : no_fit.sides()) {
            const glm::dvec2 middle = (side.from + side.to) / 2.0, along = side.to - side.from;
            const double length = std::sqrt(scalar_product(along, along));
            if (length < 1e-3) continue;
            const glm::dvec2 across = left_of(along) * (1e-5 / length);
            EXPECT_FALSE(no_fit.overlaps(middle));
            EXPECT_TRUE(overlap(fixed, placed(moved, {0, middle + across}))) << round;
        }
    }
}

TEST(NoFit, HasPlacesIntoWhichPiecesJustFit) {
    const Polygon comb = {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {2, 1}, {2, 3}, {0, 3}};
    const Polygon bar = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
    const NoFit no_fit(convex_parts(comb), convex_parts(bar));
    const auto has = [&](glm::dvec2 at) {
        return std::any_of(no_fit.points().begin(), no_fit.points().end(), [&](glm::dvec2 point) {
            return std::fabs(point.x - at.x) < 1e-9 && std::fabs(point.y - at.y) < 1e-9;
        });
    };
    EXPECT_TRUE(has({2, 1}));
    EXPECT_FALSE(no_fit.overlaps({2, 1}));
    EXPECT_FALSE(no_fit.overlaps({2, 2}));
    EXPECT_TRUE(no_fit.overlaps({2.01, 1.5}));
}

TEST(PieceNest, FillsHolesThatPiecesJustFit) {
    // A frame with a square hole that opens to one side, and squares as large as the hole.
    const std::vector<Polygon> outlines = {{{0, 0}, {30, 0}, {30, 30}, {0, 30}, {0, 20}, {20, 20}, {20, 10}, {0, 10}},
                                           {{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
    PieceNest nest(outlines, false, {});
    ASSERT_TRUE(nest.is_possible());
    const std::vector<std::size_t> kinds = {0, 1};
    std::vector<std::uint64_t> left = {1, 5};
    std::vector<NestedPiece> laid;
    nest.fill({{0, 0}, {30, 30}}, {}, kinds, left, laid);
    EXPECT_EQ(left, (std::vector<std::uint64_t>{0, 3}));
    std::vector<Polygon> polygons;
    for (const NestedPiece& piece : laid) polygons.push_back(placed(outlines[piece.kind], piece.copy));
    EXPECT_LT(worst_overlap(polygons), 1e-6);
}

TEST(CuttingPlan, PlacesPiecesOneByOneWhereThatSavesSheets) {
    CuttingOptions options{.sheet = {297, 420, 10}};
    const std::vector<CutKind> kinds = kinds_of("spectre", "3", 14);
    const CuttingPlan plan = plan_cutting(kinds, options, {});
    // Rows of spectres need 13 sheets.
    EXPECT_LE(plan.sheet_count, 12U);
    std::map<std::size_t, std::uint64_t> counted;
    for (const CuttingSheet& sheet : plan.sheets) {
        std::vector<Polygon> polygons;
        for (const PlacedForm& piece : sheet.pieces) {
            counted[plan.forms[piece.form].kind] += sheet.copies;
            polygons.push_back(placed(plan.forms[piece.form].cut, {0, piece.at}));
            const Box box = box_of(polygons.back());
            EXPECT_TRUE(box.low.x > 10 - 1e-6 && box.low.y > 10 - 1e-6);
            EXPECT_TRUE(box.high.x < 287 + 1e-6 && box.high.y < 410 + 1e-6);
        }
        EXPECT_LT(worst_overlap(polygons), 1e-5);
    }
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) EXPECT_EQ(counted[kind], kinds[kind].pieces);
}

TEST(CuttingPlan, IsTheSameInEveryRun) {
    const CuttingOptions options{.sheet = {297, 420, 10}, .gap = 1};
    const std::vector<CutKind> kinds = kinds_of("spectre", "2", 14);
    const CuttingPlan plan = plan_cutting(kinds, options, {}), again = plan_cutting(kinds, options, {});
    ASSERT_EQ(again.sheets.size(), plan.sheets.size());
    for (std::size_t i = 0; i < plan.sheets.size(); ++i) {
        ASSERT_EQ(again.sheets[i].pieces.size(), plan.sheets[i].pieces.size());
        for (std::size_t k = 0; k < plan.sheets[i].pieces.size(); ++k) {
            EXPECT_EQ(again.sheets[i].pieces[k].at, plan.sheets[i].pieces[k].at);
        }
    }
}

TEST(CuttingPlan, LaysEveryPieceOnceOnSheetsOfItsColour) {
    CuttingOptions options{.sheet = {297, 420, 10}, .kerf = 0.2};
    for (const bool grain : {false, true}) {
        options.grain = grain;
        for (const std::string tiling : {"hat", "penrose-rhombs", "snub-square", "pinwheel"}) {
            const std::vector<CutKind> kinds = kinds_of(tiling, "3", 9, grain);
            const CuttingPlan plan = plan_cutting(kinds, options, {});
            std::map<std::size_t, std::uint64_t> counted;
            std::uint64_t sheets = 0;
            for (const CuttingSheet& sheet : plan.sheets) {
                std::vector<Polygon> polygons;
                for (const PlacedForm& piece : sheet.pieces) {
                    const PieceForm& form = plan.forms[piece.form];
                    counted[form.kind] += sheet.copies;
                    EXPECT_EQ(plan.kinds[form.kind].colour, sheet.colour);
                    polygons.push_back(placed(form.cut, {0, piece.at}));
                    if (polygons.size() > 120) polygons.pop_back();
                }
                EXPECT_LT(worst_overlap(polygons), 1e-5) << tiling;
                EXPECT_TRUE(sheet.in_use > 0 && sheet.in_use < 1) << tiling;
                sheets += sheet.copies;
            }
            EXPECT_EQ(sheets, plan.sheet_count);
            for (std::size_t kind = 0; kind < kinds.size(); ++kind) EXPECT_EQ(counted[kind], kinds[kind].pieces);
        }
    }
}

TEST(CuttingPlan, ManyPiecesNeedFewDifferentSheets) {
    CuttingOptions options{.sheet = {297, 420, 10}};
    std::vector<CutKind> kinds = kinds_of("chair", "2", 10);
    for (CutKind& kind : kinds) kind.pieces = 1'000'000;
    const CuttingPlan plan = plan_cutting(kinds, options, {});
    EXPECT_LE(plan.sheets.size(), 2 * kinds.size());
    EXPECT_GT(plan.sheet_count, 10'000U);
}

TEST(CuttingPlan, NeighboursKeepTheirGap) {
    CuttingOptions options{.sheet = {200, 200, 5}, .gap = 3};
    const CuttingPlan plan = plan_cutting(kinds_of("sphinx", "2", 8), options, {});
    for (const CuttingSheet& sheet : plan.sheets) {
        std::vector<Polygon> grown;
        for (const PlacedForm& piece : sheet.pieces) {
            const PieceForm& form = plan.forms[piece.form];
            grown.push_back(offset_outline(placed(form.cut, {0, piece.at}), 1.5));
            const Box box = box_of(placed(form.cut, {0, piece.at}));
            EXPECT_TRUE(box.low.x > 5 - 1e-6 && box.high.x < 195 + 1e-6);
        }
        EXPECT_LT(worst_overlap(grown), 1e-5);
    }
}

TEST(CuttingPlan, RefusesPiecesThatDoNotFit) {
    CuttingOptions options{.sheet = {100, 80, 10}};
    EXPECT_EQ(error_of<std::runtime_error>([&] { plan_cutting(kinds_of("chair", "1", 45), options, {}); }),
              "piece A needs 90.0 x 90.0 mm, but the sheets are 80 x 60 mm within their margins");
    EXPECT_THROW(plan_cutting({}, options, {}), std::runtime_error);
    options.sheet = {10'000, 10'000, 0};
    std::vector<CutKind> many = kinds_of("chair", "1", 1);
    many.front().pieces = 100'000'000;
    EXPECT_THROW(plan_cutting(many, options, {}), std::runtime_error);
}

TEST(CuttingSheets, FilesAppearInAllFormats) {
    CuttingOptions options{.sheet = {120, 90, 8}, .seam = 2};
    const CuttingPlan plan = plan_cutting(kinds_of("penrose-rhombs", "2", 12), options, {});
    ASSERT_GT(plan.sheets.size(), 1U);
    const std::vector<std::string> materials(plan.sheets.size(), "red");
    for (const PrintFormat format : {PrintFormat::svg, PrintFormat::pdf, PrintFormat::eps, PrintFormat::png,
                                     PrintFormat::hpgl, PrintFormat::gcode, PrintFormat::dxf}) {
        PieceWriting writing;
        writing.drawing.format = format;
        writing.dpi = 50;
        const std::string name = "x." + std::string(info(format).extension);
        const auto files = sheet_files(name, format == PrintFormat::pdf ? 1 : plan.sheets.size());
        const auto written = [&] {
            MemoryDestination memory;
            write_cutting_sheets(plan, options, materials, true, writing, name, memory);
            std::string all;
            for (const auto& file : files) all += memory.take(file);
            return all;
        };
        const std::string bytes = written();
        EXPECT_FALSE(bytes.empty()) << name;
        EXPECT_EQ(bytes, written()) << name;
    }
    EXPECT_EQ(sheet_files("a/b.svg", 12)[3], std::filesystem::path("a/b-04.svg"));
    EXPECT_EQ(sheet_files("b.svg", 1)[0], std::filesystem::path("b.svg"));
}

}  // namespace sikku::cutting_test
