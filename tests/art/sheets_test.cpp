// Several documents on one sheet: places, options of each drawing, every format.
#include "art/sheets.h"

#include "tests/checks.h"
#include "tests/print_tools.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace sikku::sheets_test {

const std::string square =
    "title: Square\naxiom: F-F-F-F\nangle increment: 90\nstroke: 0.5mm #204060\nground: #ffeedd\n";
const std::string kolam =
    "title: Kolam\naxiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 1\nangle increment: 90\n"
    "stroke: 0.2 step #fffaf0\nground: #8c3b2a\n";

SheetItem item(const std::string& text, OptionValues values = {}) {
    return {parse("test.lsys", text), std::move(values)};
}

std::string made(const std::vector<SheetItem>& items, const std::string& format, OptionValues values = {}) {
    MemoryDestination memory;
    values.push_back({"dpi", "50"});
    plan_sheet(items, format, values)->make(memory, "sheet." + format, {});
    return memory.outputs().at("sheet." + format);
}

/// The grounds of the cells of an SVG, in millimetres.
std::vector<Window> grounds(const std::string& svg) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    std::vector<Window> windows;
    for (const auto& found : document.select_nodes("//rect")) {
        const pugi::xml_node rect = found.node();
        // The sheet's own ground has the size of the page.
        if (rect.attribute("x").empty() && rect.attribute("y").empty()) continue;
        windows.push_back({rect.attribute("x").as_double(), rect.attribute("y").as_double(),
                           rect.attribute("width").as_double(), rect.attribute("height").as_double()});
    }
    return windows;
}

TEST(SeveralDrawings, VariantsAreNamedInTitles) {
    const std::string text = square + "variant same: heading = 90\n";
    const SheetItem plain{parse("test.lsys", text, {}), {}};
    const SheetItem varied{parse("test.lsys", text, {"same", {}}), {}};
    EXPECT_NE(made({plain}, "svg", {{"titles", "title"}}), made({varied}, "svg", {{"titles", "title"}}));
    EXPECT_EQ(grounds(made({plain, varied}, "svg", {{"titles", "title"}})).size(), 2u);
}

TEST(SeveralDrawings, StandInColumnsWithAGutter) {
    const std::string svg = made({item(square), item(kolam), item(square), item(kolam)}, "svg",
                                 {{"columns", "2"}, {"gutter", "17mm"}, {"size", "200x300mm"}});
    const std::vector<Window> cells = grounds(svg);
    ASSERT_EQ(cells.size(), 4u) << svg;
    EXPECT_NEAR(cells[1].left - cells[0].left - cells[0].width, 17, 1e-3);
    EXPECT_NEAR(cells[2].top - cells[0].top - cells[0].height, 17, 1e-3);
    EXPECT_NEAR(cells[0].top, cells[1].top, 1e-3);
    EXPECT_NEAR(cells[0].left, cells[2].left, 1e-3);
    // In the middle of the page.
    EXPECT_NEAR(cells[0].left, 200 - cells[1].left - cells[1].width, 1e-2);
}

TEST(SeveralDrawings, LieInTheirPlaces) {
    const std::vector<SheetItem> items = {
        item(square, {{"x", "20mm"}, {"y", "30mm"}, {"width", "50mm"}, {"height", "40mm"}}),
        item(kolam, {{"x", "90mm"}, {"y", "30mm"}, {"rotate", "90"}, {"border", "rope"}, {"dots", ""}})};
    const std::vector<Window> cells = grounds(made(items, "svg"));
    ASSERT_EQ(cells.size(), 2u);
    EXPECT_NEAR(cells[0].left, 20, 1e-3);
    EXPECT_NEAR(cells[0].top, 30, 1e-3);
    EXPECT_NEAR(cells[0].width, 50, 1e-3);
    EXPECT_NEAR(cells[0].height, 40, 1e-3);
    // Up to the margins of an A4 page.
    EXPECT_NEAR(cells[1].width, 210 - 90 - 10, 1e-3);
    EXPECT_NEAR(cells[1].height, 297 - 30 - 10, 1e-3);
    EXPECT_THROW(made({items[0], item(kolam)}, "svg"), std::runtime_error);
    EXPECT_THROW(made({item(square, {{"x", "190mm"}, {"width", "40mm"}})}, "svg"), SettingError);
    EXPECT_THROW(made({item(square, {{"width", "40mm"}})}, "svg"), SettingError);
    // Pictures draw each on its own ground; lines may lie over each other.
    const std::vector<SheetItem> overlapping = {item(square, {{"x", "20mm"}}), item(kolam, {{"x", "30mm"}})};
    EXPECT_NO_THROW(made(overlapping, "svg"));
    EXPECT_THROW(made(overlapping, "png"), std::runtime_error);
}

TEST(SeveralDrawings, HaveOptionsOfTheirOwn) {
    const auto made_with = [&](OptionValues first, OptionValues all) {
        return made({item(kolam, std::move(first)), item(kolam)}, "svg", std::move(all));
    };
    const std::string plain = made_with({}, {});
    const std::size_t one = count_of(made_with({{"dots", ""}}, {}), "<circle");
    EXPECT_EQ(count_of(plain, "<circle"), 0u);
    EXPECT_GT(one, 0u);
    EXPECT_EQ(count_of(made_with({}, {{"dots", ""}}), "<circle"), 2 * one);
    // A value of a drawing comes before that of all; keys of its pattern are values, too.
    EXPECT_TRUE(has(made_with({{"stroke", "1mm lime"}}, {{"stroke", "1mm navy"}}), "#00ff00"));
    EXPECT_NE(made_with({{"derivation length", "2"}}, {}), plain);
    EXPECT_GT(count_of(made_with({{"repeat", "frieze:3"}}, {}), "<path"), count_of(plain, "<path"));
    EXPECT_NE(made_with({}, {{"titles", "title"}}), plain);
    EXPECT_NE(made_with({{"title", "Mine"}}, {}), plain);
    EXPECT_THROW(made_with({{"size", "A3"}}, {}), SettingError);
    EXPECT_THROW(made_with({{"nonsense", "1"}}, {}), SettingError);
    EXPECT_THROW(made_with({}, {{"nonsense", "1"}}), SettingError);
    EXPECT_THROW(made_with({}, {{"tile", "A4"}}), SettingError);
    EXPECT_THROW(made_with({}, {{"generations", "1:2"}}), SettingError);
    EXPECT_THROW(made({}, "svg"), SettingError);
    EXPECT_THROW(made({item(square)}, "gif"), SettingError);
    EXPECT_THROW(made({item(square)}, "glb"), SettingError);
}

/// The corners of a square of one step are where its place says, to the hundredth of a millimetre of HP-GL.
TEST(SeveralDrawings, ArePlottedInTheirPlaces) {
    const std::vector<SheetItem> items = {
        item(square, {{"x", "20mm"}, {"y", "30mm"}, {"width", "40mm"}, {"height", "40mm"}, {"step", "20mm"}}),
        item(square, {{"x", "100mm"},
                      {"y", "30mm"},
                      {"width", "40mm"},
                      {"height", "40mm"},
                      {"step", "20mm"},
                      {"rotate", "45"}})};
    const std::string plot = made(items, "gcode");
    double low_x = 1e9, high_x = -1e9, low_y = 1e9;
    bool is_down = false;
    for (std::size_t at = 0; (at = plot.find("\nG1 X", at)) != std::string::npos; ++at) {
        is_down = true;
        const double x = std::stod(plot.substr(at + 5));
        const double y = std::stod(plot.substr(plot.find('Y', at) + 1));
        low_x = std::min(low_x, x);
        high_x = std::max(high_x, x);
        low_y = std::min(low_y, y);
    }
    EXPECT_TRUE(is_down) << plot;
    EXPECT_NEAR(low_x, 30, 0.02);
    EXPECT_NEAR(high_x, 120 + 20 / std::sqrt(2.0), 0.02);
    EXPECT_NEAR(low_y, 297 - 50 - 20 / std::sqrt(2.0), 0.02);
    for (const char* format : {"hpgl", "svg", "pdf"}) {
        const OptionValues plotter = {{"plotter", "true"}};
        EXPECT_GT(made(items, format, plotter).size(), 200u) << format;
    }
}

TEST(SeveralDrawings, NameTheirTiles) {
    const std::string tile = "axiom: {F+F+F+F}\nangle increment: 90\nfill: #ff0000\n";
    const std::string svg = made({item(tile), item(tile)}, "svg", {{"name-tiles", "true"}});
    EXPECT_EQ(count_of(svg, "id=\"t1\" class=\"shape-1 "), 1u) << svg;
    EXPECT_EQ(count_of(svg, "id=\"t2\" class=\"shape-1 "), 1u) << svg;
    const std::string dxf = made({item(tile), item(tile)}, "dxf", {{"name-tiles", "true"}});
    EXPECT_EQ(count_of(dxf, "POLYLINE\n8\nSHAPE-1-FF0000\n"), 2u) << dxf;
}

TEST(SeveralDrawings, LookTheSameInPicturesAndVectors) {
    if (!has_program("pdftoppm") || !has_program("oiiotool")) GTEST_SKIP() << "no pdftoppm or no oiiotool";
    const ScratchFolder folder;
    const std::vector<SheetItem> items = {
        item(kolam, {{"x", "10mm"}, {"y", "20mm"}, {"width", "80mm"}, {"height", "90mm"}, {"border", "diamonds"}}),
        item(square, {{"x", "110mm"}, {"y", "60mm"}, {"width", "60mm"}, {"height", "100mm"}})};
    const auto write = [&](const std::string& name) {
        plan_sheet(items, name.substr(name.find('.') + 1), {{"dpi", "72"}, {"size", "200x200mm"}})
            ->make(file_system(), folder / name, {});
    };
    write("a.pdf");
    write("a.png");
    const PixelGrid pdf = render_pdf(folder / "a.pdf", 72);
    const PixelGrid png = read_by_oiiotool(folder / "a.png");
    ASSERT_EQ(pdf.width, png.width);
    ASSERT_EQ(pdf.height, png.height);
    std::int64_t difference = 0;
    for (std::size_t i = 0; i < pdf.bytes.size(); ++i) {
        difference += std::abs(static_cast<unsigned char>(pdf.bytes[i]) - static_cast<unsigned char>(png.bytes[i]));
    }
    EXPECT_LT(static_cast<double>(difference) / static_cast<double>(pdf.bytes.size()), 3.0);
}

/// The same kolam, once in steps of double length: dots are as large as they are far apart.
TEST(SeveralDrawings, OfOneScaleHaveTheirDotsEquallyFarApart) {
    const std::string doubled =
        "axiom: FF+XFF+FF+XFF\nX --> XFF-FF-FF+XFF+FF+XFF-FF-FF+X\nderivation length: 2\nangle increment: 90\n"
        "stroke: 0.4 step #fffaf0\nground: #8c3b2a\n";
    const auto radii = [&](OptionValues values) {
        values.push_back({"dots", ""});
        pugi::xml_document document;
        EXPECT_TRUE(document.load_string(made({item(kolam), item(doubled)}, "svg", std::move(values)).c_str()));
        double least = 1e300, most = 0;
        for (const auto& found : document.select_nodes("//circle")) {
            const double radius = found.node().attribute("r").as_double();
            least = std::min(least, radius);
            most = std::max(most, radius);
        }
        return most / least;
    };
    EXPECT_GT(radii({}), 1.5);
    EXPECT_NEAR(radii({{"same-scale", "true"}}), 1, 0.01);
}

TEST(SeveralDrawings, ShareAScaleOrADotSpacing) {
    const auto steps = [&](OptionValues values) {
        const std::string large = "axiom: FF-FF-FF-FF\nangle increment: 90\n";
        return made({item(square), item(large)}, "svg", std::move(values));
    };
    EXPECT_NE(steps({}), steps({{"same-scale", "true"}}));
    const std::string spaced = made({item(kolam), item(kolam, {{"derivation length", "2"}})}, "svg",
                                    {{"dot-spacing", "4mm"}, {"size", "A2"}});
    EXPECT_GT(count_of(spaced, "<circle"), 20u);
}

}  // namespace sikku::sheets_test
