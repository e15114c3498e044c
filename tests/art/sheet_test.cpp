#include "art/sheet/sheet.h"

#include "art/prints.h"
#include "engine/derivation/derivation.h"
#include "engine/geometry/lettering.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <algorithm>
#include <fstream>
#include <pugixml.hpp>
#include <regex>

namespace sikku::sheet_test {

constexpr std::string_view kolam =
    "axiom: F+F+F+F\nF --> F+F-F-FF+F+F-F\nderivation length: 2\n"
    "stroke: 0.3 step #fffaf0\nground: #8c3b2a\n";
constexpr std::string_view tiles =
    "axiom: {F+F+F+F}f{F+F+F+F}@O(0.3)\npalette: #102030 #c08040\nground: #e0f0ff\nstroke: 0.4mm\n";
constexpr std::string_view wave =
    "axiom: F-F+F-F+F-F\nline: spline\nstroke: 1.5mm #204060\nground: #ffffff\nangle factor: 6\n";
constexpr std::string_view bush =
    "axiom: F\nF --> F[+F]F[-F]F\nangle factor: 14\nderivation length: 3\nstroke: 0.2mm green\nground: none\n";

class Sheets : public ::testing::Test {
protected:
    Sheets() {
        options_.page = {120.0, 160.0, 8.0};
        options_.dpi = 150.0;
        options_.title = "Föur ><& prints";
        options_.subtitle = "of a test";
        options_.made = "sikku test";
    }

    static SheetCell cell(std::string_view text, const std::string& title = "Title") {
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern("test.lsys", std::string(text), diagnostics);
        SheetCell result;
        result.grammar = std::make_shared<const Grammar>(compile_grammar(pattern, diagnostics));
        result.style = read_style(pattern, 300.0, diagnostics);
        diagnostics.throw_if_errors();
        result.title = title;
        result.caption = caption_of(*result.grammar, title, pattern);
        return result;
    }
    static std::vector<SheetCell> four() {
        return {cell(kolam, "Kolam"), cell(tiles, "Tiles"), cell(wave, "A <wave>"), cell(bush, "Bush")};
    }

    SheetLayout write(const std::vector<SheetCell>& cells, const std::string& name) {
        options_.format = print_format(name).value();
        return draw_sheet(cells, options_, folder_ / name);
    }

    PixelGrid svg_pixels(const std::string& name) {
        const auto pdf = folder_ / (name + ".pdf");
        const ToolOutcome outcome =
            run_tool("rsvg-convert -f pdf -o '" + pdf.string() + "' '" + folder_.file(name) + "'");
        EXPECT_TRUE(outcome.ok) << outcome.text;
        return render_pdf(pdf, static_cast<int>(options_.dpi));
    }
    PixelGrid image_pixels(const std::string& name) { return read_by_oiiotool(folder_ / name); }
    int at(double millimetres) const { return static_cast<int>(millimetres * options_.dpi / 25.4); }

    /// Just within the four corners of each window its ground is seen, and just outside that of the sheet.
    void expect_grounds(const PixelGrid& pixels, const std::vector<SheetCell>& cells, const SheetLayout& layout) {
        ASSERT_EQ(layout.windows.size(), cells.size());
        const Colour sheet = options_.ground.value_or(Colour{255, 255, 255, 255});
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const Window& window = layout.windows[i];
            const Colour ground = cells[i].style.ground.value_or(sheet);
            for (const double x : {0.0, 1.0}) {
                for (const double y : {0.0, 1.0}) {
                    const auto seen = [&](double inset) {
                        return pixels.at(at(window.left + x * window.width + (1 - 2 * x) * inset),
                                         at(window.top + y * window.height + (1 - 2 * y) * inset));
                    };
                    EXPECT_TRUE(near(seen(0.5), ground)) << i << " " << x << " " << y;
                    if (y == 0.0) {
                        EXPECT_TRUE(near(seen(-0.5), sheet)) << i << " " << x << " " << y;
                    }
                }
            }
        }
    }

    ScratchFolder folder_;
    SheetOptions options_;
};

TEST_F(Sheets, RowsAreBalanced) {
    options_.columns = 3;
    const auto rows = [&](std::size_t count) {
        std::vector<int> list;
        double top = -1;
        for (const Window& window : write(std::vector<SheetCell>(count, cell(kolam)), "sheet.svg").windows) {
            if (window.top != top) list.push_back(0);
            top = window.top;
            ++list.back();
        }
        return list;
    };
    EXPECT_EQ(rows(7), (std::vector{3, 2, 2}));
    EXPECT_EQ(rows(4), (std::vector{2, 2}));
    EXPECT_EQ(rows(9), (std::vector{3, 3, 3}));
    EXPECT_EQ(rows(8), (std::vector{3, 3, 2}));
    options_.columns = 0;
    const SheetLayout layout = write(std::vector<SheetCell>(7, cell(kolam)), "sheet.svg");
    // Shorter rows stand in the middle.
    const Window& first = layout.windows.front();
    const Window& last = layout.windows.back();
    const double left =
        std::min_element(layout.windows.begin(), layout.windows.end(), [](const Window& a, const Window& b) {
            return a.left < b.left;
        })->left;
    EXPECT_GE(last.left + 1e-9, left);
    EXPECT_EQ(first.width, last.width);
}

TEST_F(Sheets, CaptionsEndBeforeTheNextRow) {
    // High drawings make narrow cells, in which captions have more lines.
    options_.title.clear();
    options_.subtitle.clear();
    const std::string high =
        "axiom: FFFFFFFF\nF --> F\nderivation length: 1\nX --> FFFF-FF++FFF-FFFF+FF-FF+FF-FFFFF\n"
        "Y --> FFFF-FF++FFF-FFFF+FF-FF+FF-FFFFF\n";
    for (const std::size_t count : {6u, 9u, 14u}) {
        const SheetLayout layout =
            write(std::vector<SheetCell>(count, cell(high, "A title of some length")), "s.svg");
        pugi::xml_document document;
        ASSERT_TRUE(document.load_file((folder_ / "s.svg").c_str()));
        std::size_t strokes = 0;
        // Letters are strokes of the sheet itself, which come before the cells.
        for (const auto& found : document.select_nodes("/svg/g/path")) {
            const std::string d = found.node().attribute("d").value();
            const std::size_t blank = d.find_first_of(" -", 1);
            const double x = std::stod(d.substr(1)) / 1000, y = std::stod(d.substr(blank)) / 1000;
            ++strokes;
            for (const Window& window : layout.windows) {
                const bool is_in = x > window.left && x < window.left + window.width && y > window.top + 0.1 &&
                                   y < window.top + window.height - 0.1;
                EXPECT_FALSE(is_in) << x << " " << y;
            }
        }
        EXPECT_GT(strokes, 20u);
    }
}

TEST_F(Sheets, CellsLieSideBySideWithinTheMargins) {
    for (const std::size_t count : {1u, 2u, 3u, 5u, 12u, 40u}) {
        std::vector<SheetCell> cells(count, cell(kolam));
        if (count == 40) options_.caption_lines = 2;
        const SheetLayout layout = write(cells, "sheet.svg");
        ASSERT_EQ(layout.windows.size(), count);
        EXPECT_GE(layout.columns * layout.rows, static_cast<int>(count));
        EXPECT_LT((layout.rows - 1) * layout.columns, static_cast<int>(count));
        for (std::size_t i = 0; i < count; ++i) {
            const Window& a = layout.windows[i];
            EXPECT_GT(a.width, 5.0);
            EXPECT_GT(a.height, 5.0);
            EXPECT_GE(a.left, 8.0 - 1e-9);
            EXPECT_GE(a.top, 8.0);
            EXPECT_LE(a.left + a.width, 112.0 + 1e-9);
            EXPECT_LE(a.top + a.height, 152.0);
            for (std::size_t k = 0; k < i; ++k) {
                const Window& b = layout.windows[k];
                EXPECT_TRUE(b.left + b.width < a.left || b.top + b.height < a.top || b.left > a.left + a.width);
            }
        }
    }
    options_.columns = 3;
    EXPECT_EQ(write(four(), "sheet.svg").columns, 3);
    EXPECT_EQ(write(four(), "sheet.svg").rows, 2);
}

TEST_F(Sheets, SvgHasALayerForEachCell) {
    write(four(), "sheet.svg");
    if (has_program("xmllint")) {
        const ToolOutcome outcome = run_tool("xmllint --noout '" + folder_.file("sheet.svg") + "'");
        EXPECT_TRUE(outcome.ok) << outcome.text;
    }
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder_ / "sheet.svg").c_str()));
    const pugi::xml_node root = document.document_element();
    EXPECT_STREQ(root.child("title").text().get(), "Föur ><& prints");
    std::vector<std::string> labels;
    for (const pugi::xml_node group : root.children("g")) {
        EXPECT_STREQ(group.attribute("inkscape:groupmode").value(), "layer");
        labels.emplace_back(group.attribute("inkscape:label").value());
    }
    EXPECT_EQ(labels,
              (std::vector<std::string>{"ground", "1 #2a2622", "2 #665f56", "Kolam", "Tiles", "A <wave>", "Bush"}));
    EXPECT_TRUE(root.select_node("g[@inkscape:label='Tiles']/g[@inkscape:label='fills']"));
    EXPECT_FALSE(root.select_node("g[@inkscape:label='Bush']/g[@inkscape:label='ground']"));
    EXPECT_FALSE(root.select_node("//clipPath"));
}

TEST_F(Sheets, PensAreThinnerThanOnAPageOfTheirOwn) {
    const SheetLayout layout = write(four(), "sheet.svg");
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder_ / "sheet.svg").c_str()));
    const auto width = [&](const std::string& title) {
        return document.select_node(("//g[@inkscape:label='" + title + "']/g[@stroke-width]").c_str())
                   .node()
                   .attribute("stroke-width")
                   .as_double() /
               1000;
    };
    const double side = std::min(layout.windows[0].width, layout.windows[0].height) * (1 - 2 * options_.inset);
    EXPECT_NEAR(width("A <wave>"), 1.5 * side / 190, 1e-3);
    EXPECT_NEAR(width("Bush"), 0.1, 1e-3) << "not thinner than can be printed";
    EXPECT_GT(width("Kolam"), 0.1);
}

TEST_F(Sheets, PicturesPdfAndSvgShowTheSame) {
    if (!has_program("rsvg-convert") || !has_program("pdftoppm") || !has_program("oiiotool")) {
        GTEST_SKIP() << "no rsvg-convert, no pdftoppm or no oiiotool on this machine";
    }
    const auto cells = four();
    std::vector<PixelGrid> pictures;
    for (const std::string name : {"sheet.png", "sheet.tif", "sheet.svg", "sheet.pdf"}) {
        const SheetLayout layout = write(cells, name);
        if (name.ends_with("svg")) {
            pictures.push_back(svg_pixels(name));
        } else if (name.ends_with("pdf")) {
            pictures.push_back(render_pdf(folder_ / name, static_cast<int>(options_.dpi)));
        } else {
            pictures.push_back(image_pixels(name));
        }
        SCOPED_TRACE(name);
        expect_grounds(pictures.back(), cells, layout);
    }
    const PixelGrid& first = pictures.front();
    EXPECT_EQ(pictures[1].bytes, first.bytes);
    for (const PixelGrid& other : pictures) {
        ASSERT_NEAR(other.width, first.width, 1);
        ASSERT_NEAR(other.height, first.height, 1);
        double difference = 0;
        int pixels = 0;
        for (int y = 0; y < std::min(first.height, other.height); ++y) {
            for (int x = 0; x < std::min(first.width, other.width); ++x) {
                difference += std::abs(first.at(x, y).green - other.at(x, y).green);
                ++pixels;
            }
        }
        EXPECT_LT(difference / pixels, 2.5);
    }
}

TEST_F(Sheets, TheSameCellsMakeTheSameBytes) {
    const auto cells = four();
    for (const std::string format : {"svg", "pdf", "png", "tif"}) {
        options_.threads = 1;
        write(cells, "a." + format);
        options_.threads = 3;
        write(cells, "b." + format);
        EXPECT_EQ(contents(folder_ / ("a." + format)), contents(folder_ / ("b." + format))) << format;
    }
    EXPECT_EQ(folder_.names().size(), 8u);
}

TEST_F(Sheets, PicturesOfLittleMemoryAreTheSame) {
    options_.page = {600.0, 800.0, 20.0};
    options_.format = PrintFormat::png;
    const auto cells = four();
    EXPECT_GT(sheet_memory(cells, options_), 25e6) << "a row of the sheet is kept";
    write(cells, "all.png");
    options_.memory = 20e6;
    EXPECT_LT(sheet_memory(cells, options_), 20e6);
    write(cells, "bands.png");
    EXPECT_TRUE(contents(folder_ / "all.png") == contents(folder_ / "bands.png"));
    options_.memory = 8e6;
    EXPECT_GT(sheet_memory(cells, options_), 8e6);
    EXPECT_THROW(write(cells, "none.png"), std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "none.png"));
    options_.format = PrintFormat::svg;
    EXPECT_EQ(sheet_memory(cells, options_), 0);
}

TEST_F(Sheets, ATransparentSheetStaysSo) {
    if (!has_program("oiiotool")) GTEST_SKIP() << "no oiiotool on this machine";
    options_.ground.reset();
    write(four(), "sheet.png");
    const ToolOutcome info = run_tool("oiiotool --info '" + folder_.file("sheet.png") + "'");
    EXPECT_TRUE(has(info.text, "4 channel"));
}

TEST_F(Sheets, PdfIsSound) {
    if (!has_program("qpdf")) GTEST_SKIP() << "no qpdf on this machine";
    write(four(), "sheet.pdf");
    const ToolOutcome outcome = run_tool("qpdf --check '" + folder_.file("sheet.pdf") + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
}

TEST_F(Sheets, WhatIsLargerThanItsCellIsCutOff) {
    SheetCell large = cell(kolam, "Large");
    large.placement.step = 40.0;
    large.style.stroke = {2.0, false, 1.0};
    const std::vector<SheetCell> cells = {cell(tiles), large};
    options_.columns = 1;
    for (const std::string name : {"sheet.svg", "sheet.pdf", "sheet.png"}) {
        const SheetLayout layout = write(cells, name);
        if (!has_program("rsvg-convert") || !has_program("pdftoppm") || !has_program("oiiotool")) continue;
        const PixelGrid pixels = name.ends_with("svg")   ? svg_pixels(name)
                                 : name.ends_with("pdf") ? render_pdf(folder_ / name, 150)
                                                         : image_pixels(name);
        const Window& window = layout.windows[1];
        for (double x = 1.0; x < 119.0; x += 0.1) {
            if (x > window.left - 0.3 && x < window.left + window.width + 0.3) continue;
            ASSERT_TRUE(near(pixels.at(at(x), at(window.top + window.height / 2)), *options_.ground)) << name << x;
        }
    }
    EXPECT_TRUE(has(contents(folder_ / "sheet.svg"), "<clipPath id=\"window2\">"));
}

TEST_F(Sheets, GenerationsAreRowsWithHeadings) {
    SheetCell koch = cell(kolam, "Koch");
    koch.heading = "Koch";
    SheetCell plant = cell(bush, "Bush");
    plant.heading = "Bush";
    std::vector<SheetCell> cells = generations(koch, 0, 3);
    for (SheetCell& more : generations(plant, 1, 3)) cells.push_back(std::move(more));
    ASSERT_EQ(cells.size(), 7u);
    EXPECT_EQ(cells[2].caption, std::vector<std::string>{"n = 2"});
    EXPECT_EQ(cells[2].title, "Koch, n = 2");
    EXPECT_EQ(cells[2].grammar->steps(), 2);
    EXPECT_TRUE(cells[2].heading.empty());
    options_.columns = 4;
    const SheetLayout layout = write(cells, "rows.svg");
    EXPECT_EQ(layout.columns, 4);
    EXPECT_EQ(layout.rows, 2);
    // Rows are broken where that fills the sheet.
    options_.columns = 0;
    const SheetLayout broken = write(cells, "broken.svg");
    EXPECT_LT(broken.columns, 4);
    EXPECT_GT(broken.windows[0].width, 1.2 * layout.windows[0].width);
    EXPECT_EQ(broken.windows[4].left, broken.windows[0].left);
    // Equally long steps: the first generation is one, whatever the last.
    options_.same_scale = true;
    write(cells, "same.svg");
    const auto extent = [&](const std::string& name, const std::string& title) {
        pugi::xml_document document;
        EXPECT_TRUE(document.load_file((folder_ / name).c_str()));
        const std::string data = document.select_node(("//g[@inkscape:label='" + title + "']//path").c_str())
                                     .node()
                                     .attribute("d")
                                     .value();
        std::smatch side;
        EXPECT_TRUE(std::regex_search(data, side, std::regex("[hv]-?([0-9]+)"))) << data;
        return std::stod(side[1]);
    };
    EXPECT_NEAR(extent("same.svg", "Koch, n = 0"), extent("same.svg", "Koch, n = 3"), 2.0);
    EXPECT_GT(extent("rows.svg", "Koch, n = 0"), 5 * extent("rows.svg", "Koch, n = 3"));
}

TEST_F(Sheets, OfGenerationsFillThePageAndKeepDotsAndBorders) {
    NEEDS("rsvg-convert");
    const Document document = parse("kolam.lsys",
                                    "axiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nangle increment: 90\n"
                                    "stroke: 0.2 step #f2b632\nground: #8c3b2a\n");
    const auto drawn = [&](const std::string& name, OptionValues values) {
        values.insert(values.end(), {{"generations", "0:3"}, {"size", "120x120mm"}});
        std::ofstream(folder_ / name) << draw(document, "svg", values);
        return svg_pixels(name);
    };
    const auto share = [](const PixelGrid& pixels, Colour colour) {
        std::int64_t found = 0;
        for (int y = 0; y < pixels.height; ++y) {
            for (int x = 0; x < pixels.width; ++x) found += near(pixels.at(x, y), colour) ? 1 : 0;
        }
        return static_cast<double>(found) / pixels.width / pixels.height;
    };
    const Colour ground{0x8c, 0x3b, 0x2a, 255}, white{0xff, 0xff, 0xff, 255};
    const PixelGrid plain = drawn("plain.svg", {});
    EXPECT_GT(share(plain, ground), 0.45);
    EXPECT_LT(share(plain, white), 1e-3);
    const PixelGrid dotted = drawn("dotted.svg", {{"dots", "5mm white"}});
    EXPECT_GT(share(dotted, white), 2e-3);
    const PixelGrid framed = drawn("framed.svg", {{"border", "kaavi"}});
    EXPECT_LT(share(framed, ground), share(plain, ground));
}

TEST_F(Sheets, CaptionsTellWhatAPatternIs) {
    const auto caption = cell(kolam, "Koch's kolam").caption;
    ASSERT_EQ(caption.size(), 3u);
    EXPECT_EQ(caption[0], "Koch's kolam");
    EXPECT_EQ(caption[1], "n = 2 · 90°");
    EXPECT_EQ(caption[2], "F\u00A0→\u00A0F+F−F−FF+F+F−F");
    for (const std::string& line : caption) EXPECT_TRUE(has_letters(line));
    const auto written = cell("axiom: A(1)\nA(x) : x<9  -->  F(x)-A(x*2) : 0.5\nA(x) --> F : 1\n").caption;
    ASSERT_EQ(written.size(), 3u);
    EXPECT_EQ(written[2],
              "A(x)\u00A0:\u00A0x<9\u00A0→\u00A0F(x)−A(x*2)\u00A0:\u00A00.5  A(x)\u00A0→\u00A0F\u00A0:\u00A01");
}

TEST_F(Sheets, FailuresNameTheCellOrTheFile) {
    const auto message = [&](const std::vector<SheetCell>& cells, const std::string& name) -> std::string {
        return error_of<std::runtime_error>([&] { write(cells, name); });
    };
    for (const std::string name : {"sheet.svg", "sheet.pdf", "sheet.png"}) {
        EXPECT_TRUE(has(message(four(), "missing/" + name), "missing/" + name));
        EXPECT_NE(message({}, name), "");
        EXPECT_TRUE(message({cell(kolam), cell("axiom: f\n", "Empty one")}, name).starts_with("'Empty one': "));
        options_.page = {20.0, 20.0, 8.0};
        EXPECT_TRUE(has(message(four(), name), "do not fit"));
        options_.page = {120.0, 160.0, 8.0};
    }
    SheetCell endless = cell(kolam, "Endless");
    endless = generations(endless, 40, 40).front();
    EXPECT_THROW(write({endless}, "sheet.svg"), BudgetError);
    EXPECT_TRUE(message({endless}, "sheet.svg").starts_with("'Endless, n = 40': "));
    EXPECT_TRUE(folder_.names().empty());
}

TEST_F(Sheets, CellsAreSeenThroughWindowsAndAtAnyOrder) {
    SheetCell window = cell(kolam, "Window");
    window = generations(window, 30, 30).front();
    window.window = parse_window("0,0,20,20");
    SheetCell large = generations(cell(kolam, "Large"), 30, 30).front();
    for (const std::string name : {"sheet.svg", "sheet.pdf", "sheet.png"}) {
        EXPECT_NO_THROW(write({window, cell(tiles)}, name)) << name;
    }
    EXPECT_TRUE(has(contents(folder_ / "sheet.svg"), "<clipPath id=\"window1\">"));
    write({large, cell(tiles)}, "large.png");
    EXPECT_THROW(write({large, cell(tiles)}, "large.svg"), BudgetError);
    options_.memory = 1e6;
    EXPECT_THROW(write({window}, "none.png"), std::runtime_error);
}

TEST_F(Sheets, AWatcherMayStopIt) {
    struct Stop : std::runtime_error {
        using std::runtime_error::runtime_error;
    };
    std::uint64_t symbols = 0;
    options_.watch = [&](std::uint64_t more) { symbols += more; };
    write(four(), "sheet.png");
    EXPECT_GT(symbols, 500u);
    options_.watch = [](std::uint64_t) { throw Stop("stop"); };
    EXPECT_THROW(write(four(), "stopped.png"), Stop);
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"sheet.png"});
}

}  // namespace sikku::sheet_test
