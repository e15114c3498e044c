// Plots as DXF: read back line by line, measured against the drawing, and read by other software.
#include "art/plotter/dxf.h"

#include "art/prints.h"
#include "art/provenance/provenance.h"
#include "engine/base/option.h"
#include "engine/base/output.h"
#include "tests/plot_tools.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

namespace sikku::dxf_test {

/// The entities of a drawing; anything that the writer has no reason to write is an error.
struct Dxf {
    struct Line {
        std::string layer;
        std::vector<glm::dvec2> points;
        std::vector<double> bulges{};  ///< of what leads on from each point
        bool is_closed = false;
        double radius = 0;  ///< of a circle around its only point

        /// Points along it, arcs included.
        std::vector<glm::dvec2> samples(double spacing) const {
            Samples along(spacing);
            if (radius > 0) {
                along.start(points[0] + glm::dvec2(radius, 0));
                along.arc(points[0], points[0] - glm::dvec2(radius, 0), true);
                along.arc(points[0], points[0] + glm::dvec2(radius, 0), true);
                return along.points;
            }
            along.start(points[0]);
            const std::size_t count = points.size() - (is_closed ? 0 : 1);
            for (std::size_t i = 0; i < count; ++i) {
                const glm::dvec2 from = points[i], to = points[(i + 1) % points.size()];
                const double bulge = bulges[i];
                if (bulge == 0) {
                    along.line(to);
                    continue;
                }
                // The middle of the arc is a sagitta to the right of the middle of its chord.
                const glm::dvec2 right(to.y - from.y, from.x - to.x);
                const glm::dvec2 middle = (from + to) / 2.0 + bulge / 2 * right;
                const glm::dvec2 a = middle - from, b = to - from;
                const double twice = 2 * (a.x * b.y - a.y * b.x);
                const glm::dvec2 centre =
                    from + (glm::dvec2(b.y, -b.x) * glm::dot(a, a) + glm::dvec2(-a.y, a.x) * glm::dot(b, b)) / twice;
                along.arc(centre, to, bulge > 0);
            }
            return along.points;
        }
    };
    std::vector<Line> lines;
    std::map<std::string, int> layers;  ///< colour numbers
    std::set<std::string> entities;
    std::map<std::string, std::string> header;
};

Dxf read_dxf(const std::string& text) {
    std::istringstream in(text);
    Dxf drawing;
    std::string code, value, section, entity, name, variable;
    Dxf::Line* line = nullptr;
    while (std::getline(in, code) && std::getline(in, value)) {
        if (code == "999") continue;
        if (code == "0") {
            entity = value;
            if (section == "ENTITIES") drawing.entities.insert(value);
            if (value == "POLYLINE" || value == "LINE" || value == "POINT" || value == "CIRCLE") {
                line = &drawing.lines.emplace_back();
                if (value != "POLYLINE") line->points.emplace_back();
                if (value == "LINE") line->points.emplace_back();
                line->bulges.resize(line->points.size());
            } else if (value == "VERTEX") {
                line->points.emplace_back();
                line->bulges.push_back(0);
            }
            continue;
        }
        if (code == "2") (entity == "SECTION" ? section : name) = value;
        if (entity == "LAYER" && code == "62") drawing.layers[name] = std::stoi(value);
        if (section == "HEADER") (code == "9" ? variable : drawing.header[variable]) = value;
        if (section != "ENTITIES") continue;
        if (entity == "VERTEX" && code == "42") line->bulges.back() = std::stod(value);
        if (entity == "CIRCLE" && code == "40") line->radius = std::stod(value);
        const auto coordinate = [&](std::size_t back) -> glm::dvec2& {
            return line->points.at(line->points.size() - back);
        };
        const bool is_line = entity == "LINE";
        if (code == "8" && entity != "VERTEX" && entity != "SEQEND") line->layer = value;
        if (entity == "POLYLINE") {
            if (code == "70") line->is_closed = value == "1";
        } else if (code == "10" || code == "20") {
            coordinate(is_line ? 2 : 1)[code == "20"] = std::stod(value);
        } else if (code == "11" || code == "21") {
            coordinate(1)[code == "21"] = std::stod(value);
        }
    }
    EXPECT_EQ(entity, "EOF");
    return drawing;
}

std::string dxf_of(const std::string& file, const OptionValues& values = {}) {
    return draw(load(bundled(file)), "dxf", values);
}

double length_of(const Dxf& drawing) {
    double length = 0;
    for (const Dxf::Line& line : drawing.lines) {
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            length += glm::distance(line.points[i - 1], line.points[i]);
        }
        if (line.is_closed) length += glm::distance(line.points.back(), line.points.front());
    }
    return length;
}

TEST(Dxf, EdgesOfTilingsHaveTheirLength) {
    // A rectangle of 50 by 25 steps with 1250 triangles of sides 1, 2 and the root of 5.
    const double edges = (1250 * (3 + std::sqrt(5.0)) + 150) / 2 * 10;
    const Dxf drawing = read_dxf(
        dxf_of("tilings/pinwheel",
               {{"derivation length", "4"}, {"step", "10mm"}, {"size", "600x600mm"}, {"tile-edges", "once"}}));
    EXPECT_NEAR(length_of(drawing), edges, 1e-4 * edges);
    EXPECT_EQ(drawing.layers, (std::map<std::string, int>{{"0", 7}, {"BORDER", 1}, {"INNER", 5}}));
    Dxf border;
    for (const Dxf::Line& line : drawing.lines) {
        if (line.layer == "BORDER") border.lines.push_back(line);
        for (const glm::dvec2 point : line.points) {
            EXPECT_TRUE(point.x >= 10 && point.y >= 10 && point.x <= 590 && point.y <= 590);
        }
    }
    EXPECT_NEAR(length_of(border), 1500, 1e-6);
    ASSERT_EQ(border.lines.size(), 1U);
    EXPECT_TRUE(border.lines[0].is_closed);
    EXPECT_EQ(drawing.entities, (std::set<std::string>{"LINE", "POLYLINE", "VERTEX", "SEQEND", "ENDSEC", "EOF"}));
}

/// 1250 triangles of 1 by 2 steps, either hand, each closed and in the layer of its kind; edges only where requested.
TEST(Dxf, TilesHaveLayersByKind) {
    for (const char* edges : {"none", "once", "each"}) {
        SCOPED_TRACE(edges);
        const Dxf drawing = read_dxf(dxf_of("tilings/pinwheel", {{"derivation length", "4"},
                                                                 {"step", "10mm"},
                                                                 {"size", "600x600mm"},
                                                                 {"tile-edges", edges},
                                                                 {"tile-colours", "hand"},
                                                                 {"name-tiles", "true"}}));
        std::map<std::string, int> tiles;
        std::size_t others = 0;
        for (const Dxf::Line& line : drawing.lines) {
            if (!line.layer.starts_with("SHAPE-")) {
                ++others;
                continue;
            }
            ++tiles[line.layer];
            EXPECT_TRUE(line.is_closed);
            ASSERT_EQ(line.points.size(), 3U);
            const glm::dvec2 a = line.points[1] - line.points[0], b = line.points[2] - line.points[0];
            EXPECT_NEAR(std::fabs(a.x * b.y - a.y * b.x) / 2, 100, 1e-2);
        }
        ASSERT_EQ(tiles.size(), 2U);
        EXPECT_EQ(tiles.begin()->second + tiles.rbegin()->second, 1250);
        EXPECT_EQ(tiles.begin()->first.substr(0, 8), "SHAPE-1-");
        EXPECT_EQ(tiles.rbegin()->first.substr(0, 18), "SHAPE-1-REFLECTED-");
        for (const auto& [layer, count] : tiles) EXPECT_TRUE(drawing.layers.contains(layer)) << layer;
        EXPECT_EQ(others == 0, std::string(edges) == "none");
        EXPECT_EQ(drawing.layers.contains("BORDER"), std::string(edges) == "once");
    }
    for (const auto& [option, value] : OptionValues{{"hatch", "2mm"}, {"resume", "1mm"}}) {
        EXPECT_THROW(dxf_of("tilings/chair", {{"name-tiles", "true"}, {option, value}}), SettingError) << option;
    }
    const std::string squares = "axiom: {F+F+F+F}f;{F+F+F+F}\nangle increment: 90\npalette: #ff000080 #ff0000\n";
    const Dxf drawing = read_dxf(draw(parse("squares.lsys", squares), "dxf", {{"name-tiles", "true"}}));
    EXPECT_TRUE(drawing.layers.contains("SHAPE-1-FF000080"));
    EXPECT_TRUE(drawing.layers.contains("SHAPE-1-FF0000"));
}

TEST(Dxf, CurvesStayWithinAHundredthOfAMillimetre) {
    const PlacedPattern kolam("kolams/snake-kolam", 3, {105, 148, 10});
    for (const bool is_kolam : {true, false}) {
        const Print print = is_kolam ? kolam.print : plain_print();
        const auto plan = arranged(print, [&](PathSink& sink) { is_kolam ? kolam.read(sink) : draw_curves(sink); });
        MemoryOutput output;
        const auto writer = write_dxf(print, output);
        plan->draw(*writer);
        writer->finish();
        const Dxf drawing = read_dxf(output.bytes());
        constexpr double spacing = 0.005;
        const auto lines = true_lines(*plan, print, spacing);
        ASSERT_EQ(drawing.lines.size(), lines.size());
        for (std::size_t i = 0; i < lines.size(); ++i) {
            EXPECT_LE(hausdorff(drawing.lines[i].samples(spacing), lines[i]), 0.0105 + spacing / 2) << i;
        }
        std::size_t arcs = 0, vertices = 0;
        for (const Dxf::Line& line : drawing.lines) {
            vertices += line.points.size();
            arcs += static_cast<std::size_t>(
                std::count_if(line.bulges.begin(), line.bulges.end(), [](double bulge) { return bulge != 0; }));
        }
        EXPECT_GT(arcs, 0u);
        // Chords would take several times as many.
        if (is_kolam) {
            EXPECT_LT(vertices, plan->report().segments * 3);
        }
    }
}

TEST(Dxf, StatesMillimetres) {
    const Dxf drawing = read_dxf(dxf_of("tilings/chair"));
    EXPECT_EQ(drawing.header.at("$ACADVER"), "AC1009");
    EXPECT_EQ(drawing.header.at("$INSUNITS"), "4");
    EXPECT_EQ(drawing.header.at("$MEASUREMENT"), "1");
}

TEST(Dxf, DotsAreCirclesOfTheirSize) {
    const Dxf drawing = read_dxf(dxf_of("kolams/snake-kolam", {{"dots", "1.5mm #0000ff"}, {"size", "200x200mm"}}));
    std::size_t circles = 0;
    for (const Dxf::Line& line : drawing.lines) {
        if (line.radius == 0) continue;
        ++circles;
        EXPECT_NEAR(line.radius, 0.75, 0.0002);
    }
    EXPECT_EQ(circles, 341u);
    // A pen of a given width fills them.
    const Dxf filled = read_dxf(
        dxf_of("kolams/snake-kolam", {{"dots", "1.5mm #0000ff"}, {"pen-width", "0.3mm"}, {"size", "200x200mm"}}));
    EXPECT_FALSE(filled.entities.contains("CIRCLE"));
}

TEST(Dxf, PensHaveLayersAndDotsAreDrawn) {
    const Dxf drawing = read_dxf(dxf_of("kolams/snake-kolam", {{"border", "kaavi"}, {"dots", "1mm #0000ff"}}));
    EXPECT_EQ(drawing.layers.size(), 1 + 3u);
    std::set<std::string> used;
    for (const Dxf::Line& line : drawing.lines) used.insert(line.layer);
    EXPECT_EQ(used.size(), 3u);
    EXPECT_EQ(drawing.layers.begin()->first, "0");
    EXPECT_TRUE(std::any_of(drawing.layers.begin(), drawing.layers.end(), [](const auto& row) {
        return row.second == 5;
    })) << "blue dots";
}

TEST(Dxf, ContainsItsPattern) {
    const ScratchFolder folder;
    const std::string file = folder.write("chair.dxf", dxf_of("tilings/chair"));
    EXPECT_EQ(known_format(file).value().name, "a DXF file");
    EXPECT_EQ(read_provenance(file).value().pattern, contents(bundled("tilings/chair")));
}

TEST(Dxf, SettingsOfPensAreRefused) {
    for (const auto& [option, value] : OptionValues{{"profile", "grbl"}, {"pen", "1 speed=3"}, {"park", "0,0"}}) {
        EXPECT_THROW(dxf_of("tilings/chair", {{option, value}}), SettingError) << option;
    }
    EXPECT_THROW(dxf_of("tilings/chair", {{"step", "100mm"}}), std::runtime_error) << "off the page";
}

TEST(Dxf, OtherSoftwareReadsIt) {
    if (!run_tool("/usr/bin/python3 -c 'import ezdxf'").ok) GTEST_SKIP() << "python3-ezdxf is not installed";
    const ScratchFolder folder;
    const std::string file = folder.write(
        "kolam.dxf", dxf_of("kolams/snake-kolam", {{"border", "kaavi"}, {"dots", "1mm"}, {"size", "200x200mm"}}));
    const std::string script = folder.write("read.py", R"(
import sys, ezdxf
document = ezdxf.readfile(sys.argv[1])
auditor = document.audit()
assert not auditor.errors, auditor.errors
assert not auditor.fixes, auditor.fixes
assert document.dxfversion == 'AC1009'
assert document.units == ezdxf.units.MM and document.header['$MEASUREMENT'] == 1
assert len(document.modelspace().query('CIRCLE')) == 345  # with those of the corners
space = document.modelspace()
low = [1e9, 1e9]
high = [-1e9, -1e9]
for line in space.query('POLYLINE'):
    assert line.dxf.layer in document.layers
    for vertex in line.points():
        for axis in (0, 1):
            low[axis] = min(low[axis], vertex[axis])
            high[axis] = max(high[axis], vertex[axis])
print(len(space.query('POLYLINE')), all(10 <= value for value in low), all(value <= 190 for value in high))
)");
    const ToolOutcome outcome = run_tool("/usr/bin/python3 '" + script + "' '" + file + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
    EXPECT_TRUE(outcome.text.ends_with(" True True\n")) << outcome.text;
}

}  // namespace sikku::dxf_test
