#include "art/print/press.h"

#include "art/raster/raster.h"
#include "art/vector/pdf.h"
#include "art/vector/svg.h"
#include "art/writer/draw.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace sikku::press_test {

using Points = std::vector<glm::dvec2>;

constexpr Colour white{255, 255, 255, 255}, black{0, 0, 0, 255}, kaavi{0xb3, 0x45, 0x2c, 255};

TEST(Spot, HasANameAndAColour) {
    const Spot spot = parse_spot(" Kaavi = #b3452c ");
    EXPECT_EQ(spot.name, "Kaavi");
    EXPECT_EQ(spot.colour, kaavi);
    EXPECT_EQ(parse_spot("PANTONE 485 C=Red").name, "PANTONE 485 C");
    EXPECT_EQ(parse_spot("a=b=navy").name, "a=b");
    EXPECT_EQ(parse_spot("காவி=#fff").name, "காவி");
    EXPECT_EQ(parse_spot(std::string(127, 'x') + "=red").name.size(), 127u);
}

TEST(Spot, SaysWhatIsWrong) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "expected a name and a colour"},
        {"Kaavi", "expected a name and a colour"},
        {"=red", "its name is missing"},
        {" \t =red", "its name is missing"},
        {"Kaavi=", "its colour is missing"},
        {"Kaavi=rde", "'rde' is not a colour"},
        {"Kaavi=#12345", "'#12345' is not a colour"},
        {"Kaavi=#ff000080", "cannot be transparent"},
        {"Kaavi=transparent", "cannot be transparent"},
        {std::string(128, 'x') + "=red", "longer than 127 bytes"},
        {"All=red", "the name All is reserved"},
        {"None=red", "the name None is reserved"},
        {std::string("a\0b=red", 7), "control characters"},
        {"a\nb=red", "control characters"},
        {"\xC3=red", "invalid UTF-8"},
    };
    for (const auto& [text, part] : cases) {
        EXPECT_TRUE(has(error_of([&, &given = text] { parse_spot(given); }), part)) << text;
    }
    const auto both = [](const std::vector<std::string>& texts) { return error_of([&] { parse_spots(texts); }); };
    EXPECT_TRUE(has(both({"Kaavi=red", "Kaavi=blue"}), "two spot colours are named 'Kaavi'"));
    EXPECT_TRUE(has(both({"Kaavi=red", "Rot=#f00"}), "'Kaavi' and 'Rot' are both red"));
    EXPECT_EQ(both({"Kaavi=red", "kaavi=blue"}), "");
}

TEST(Spot, IsAColourOfTheDrawing) {
    Style style;
    style.palette = {black, Colour{255, 0, 0, 128}};
    style.ground = kaavi;
    style.fill = Colour{0, 0, 255, 255};
    const auto check = [&](const std::string& text) {
        return error_of([&] { check_spots({.spots = {parse_spot(text)}}, style); });
    };
    for (const std::string text : {"K=black", "R=red", "G=#b3452c", "B=blue"}) EXPECT_EQ(check(text), "");
    EXPECT_TRUE(has(check("G=green"), "nothing is drawn in green; the colours are #b3452c, black, blue, red"));
}

TEST(Press, RefusesWhatAFormatDoesNotHave) {
    const auto check = [](const Press& press, PrintFormat format) {
        return error_of([&] { check_press(press, format); });
    };
    for (const double bleed :
         {-1.0, 100.5, 1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_TRUE(has(check({.bleed = bleed}, PrintFormat::pdf), "0 to 100mm")) << bleed;
    }
    for (const int bits : {-1, 0, 2, 3, 16}) {
        EXPECT_TRUE(has(check({.bits = bits}, PrintFormat::tiff), "expected 1 or 8")) << bits;
    }
    const Press spots{.spots = {{"Kaavi", kaavi}}};
    for (const PrintFormat format :
         {PrintFormat::svg, PrintFormat::png, PrintFormat::tiff, PrintFormat::jpeg, PrintFormat::exr}) {
        EXPECT_EQ(check({.bleed = 100.0}, format), "");
        EXPECT_TRUE(has(check({.marks = true}, format), "only a PDF has crop marks"));
        EXPECT_TRUE(has(check(spots, format), "only a PDF has spot colours"));
        if (format == PrintFormat::tiff) continue;
        EXPECT_TRUE(has(check({.cmyk = "a.icc"}, format), "only TIFF and PDF"));
        EXPECT_TRUE(has(check({.registration = true}, format), "only a PDF has registration marks"));
        EXPECT_TRUE(has(check({.overprint = Overprint::black}, format), "only a PDF has inks"));
        EXPECT_TRUE(has(check({.bits = 1}, format), "only TIFF"));
    }
    EXPECT_EQ(check({.cmyk = "a.icc"}, PrintFormat::pdf), "");
    EXPECT_EQ(check({.cmyk = "a.icc", .overprint = Overprint::all}, PrintFormat::pdf), "");
    EXPECT_TRUE(has(check({.overprint = Overprint::black}, PrintFormat::pdf), "needs 'cmyk' or 'spot'"));
    EXPECT_TRUE(has(check({.cmyk = "a.icc", .bits = 1}, PrintFormat::tiff), "8 bits"));
    EXPECT_EQ(check({.cmyk = "a.icc"}, PrintFormat::tiff), "");
    EXPECT_EQ(check({.bits = 1}, PrintFormat::tiff), "");
    EXPECT_EQ(check({.bleed = 3.0, .marks = true, .spots = spots.spots}, PrintFormat::pdf), "");
}

TEST(Press, MarksAreInLineWithTheTrimmedEdgesAndOutsideOfTheBleed) {
    const Page page{100.0, 60.0, 5.0};
    for (const double bleed : {0.0, 1.0, 3.0, 100.0}) {
        const Press press{.bleed = bleed, .marks = true};
        const double offset = std::max(bleed, 2.0);
        EXPECT_EQ(press_edge(press), offset + 5.0);
        int upright = 0;
        for (const CropMark& mark : crop_marks(page, press)) {
            const glm::dvec2 way = mark.to - mark.from;
            EXPECT_NEAR(std::abs(way.x) + std::abs(way.y), 5.0, 1e-9);
            const bool is_upright = way.x == 0.0;
            upright += is_upright ? 1 : 0;
            const double in_line = is_upright ? mark.from.x : mark.from.y;
            const double side = is_upright ? page.width : page.height;
            EXPECT_TRUE(in_line == 0.0 || in_line == side);
            const double across = is_upright ? page.height : page.width;
            for (const glm::dvec2 end : {mark.from, mark.to}) {
                const double at = is_upright ? end.y : end.x;
                EXPECT_TRUE(at <= -offset || at >= across + offset) << at;
                EXPECT_TRUE(at >= -offset - 5.0 && at <= across + offset + 5.0) << at;
            }
        }
        EXPECT_EQ(upright, 4);
    }
    EXPECT_EQ(press_edge({}), 0.0);
    EXPECT_EQ(press_edge({.bleed = 3.0}), 3.0);
}

TEST(Press, APictureIsAsLargeAsTheBleed) {
    Print print = plain_print();
    print.press.bleed = 3.0;
    const glm::dvec2 corner = print.placement.to_page[2];
    const Print picture = as_picture(print);
    EXPECT_EQ(picture.page.width, 106.0);
    EXPECT_EQ(picture.page.height, 66.0);
    EXPECT_EQ(picture.page.margin, 8.0);
    EXPECT_EQ(picture.placement.to_page[2], corner + glm::dvec2(3.0));
    EXPECT_EQ(as_picture(picture).page.width, 106.0) << "once is enough";
}

TEST(Press, OneBitLeavesBlackAndWhite) {
    Print print = plain_print();
    print.style.palette = {kaavi, Colour{255, 230, 180, 255}, Colour{0, 0, 0, 127}, Colour{0, 0, 0, 128}};
    print.style.ground.reset();
    print.press.bits = 1;
    const Print picture = as_picture(print);
    EXPECT_EQ(picture.style.palette[0], black);
    EXPECT_EQ(picture.style.palette[1], white);
    EXPECT_EQ(picture.style.palette[2].alpha, 0);
    EXPECT_EQ(picture.style.palette[3], black);
    EXPECT_EQ(picture.style.ground, white);
    EXPECT_EQ(make_raster(picture)->channels(), 1);
}

class PressPdf : public ::testing::Test {
protected:
    template <typename Draw>
    std::filesystem::path write(const Print& print, Draw&& draw, const std::string& name = "print.pdf") {
        const auto path = folder_ / name;
        write_print(path, print, write_pdf, draw);
        return path;
    }

    /// One plate as Ghostscript separates it, 127 pixels an inch; 255 is no ink.
    std::optional<PixelGrid> plate(const std::filesystem::path& pdf, const std::string& name) {
        const std::string stem = (folder_ / "plates").string();
        if (!std::filesystem::exists(stem + ".tif")) {
            const ToolOutcome outcome =
                run_tool("gs -q -dNOPAUSE -dBATCH -dSAFER -dMaxSpots=8 -sDEVICE=tiffsep -r127 -o '" + stem +
                         ".tif' '" + pdf.string() + "'");
            EXPECT_TRUE(outcome.ok) << outcome.text;
        }
        const std::string file = stem + "(" + name + ").tif";
        if (!std::filesystem::exists(file)) return std::nullopt;
        return read_by_oiiotool(file, "0,0,0");
    }

    ScratchFolder folder_;
};

/// The four numbers after a box's name.
std::vector<double> box(const std::string& text, const std::string& name) {
    const std::size_t at = text.find(name);
    EXPECT_NE(at, std::string::npos) << name;
    std::istringstream stream(text.substr(at + name.size()));
    std::vector<double> numbers(4);
    if (stream.peek() == ' ') stream >> std::ws;
    if (stream.peek() == '[') stream.get();
    for (double& number : numbers) stream >> number;
    return numbers;
}

TEST_F(PressPdf, BoxesAreThoseOfTheSheetAndItsBleed) {
    NEEDS("qpdf");
    NEEDS("pdfinfo");
    const auto points = [](double millimetres) { return millimetres * 72.0 / 25.4; };
    for (const double bleed : {0.0, 3.0, 100.0}) {
        for (const bool marks : {false, true}) {
            Print print = plain_print();
            print.page = {297.0, 420.0, 10.0};
            print.press = {.bleed = bleed, .marks = marks};
            const auto path = write(print, draw_sampler);
            const std::string text = contents(path);
            static_cast<void>(plain_text(path));
            const std::string told = run_tool("pdfinfo -box '" + path.string() + "'").text;
            const double edge = marks ? std::max(bleed, 2.0) + 5.0 : bleed;
            const auto expect = [&](const std::string& name, double around) {
                const double corner = points(edge - around);
                const std::vector<double> expected = {corner, corner, points(edge + 297.0 + around),
                                                      points(edge + 420.0 + around)};
                const std::vector<double> written = box(text, "/" + name + " ");
                const std::vector<double> read = box(told, name + ":");
                for (std::size_t i = 0; i < 4; ++i) {
                    EXPECT_NEAR(written[i], expected[i], 1e-4) << name << " " << bleed;
                    EXPECT_NEAR(read[i], expected[i], 0.0051) << name << " " << bleed;
                }
            };
            expect("MediaBox", edge);
            expect("CropBox", edge);
            expect("BleedBox", bleed);
            expect("TrimBox", 0.0);
        }
    }
}

TEST_F(PressPdf, TheGroundReachesTheEdgeOfTheBleedAndTheDrawingStaysWhereItWas) {
    NEEDS("pdftoppm");
    Print print = plain_print();
    print.style.ground = kaavi;
    print.press = {.bleed = 3.0};
    const auto path = write(print, draw_sampler);
    for (const int dpi : {72, 254}) {
        const PixelGrid pixels = render_pdf(path, dpi);
        ASSERT_NEAR(pixels.width, 106.0 / 25.4 * dpi, 1.0);
        ASSERT_NEAR(pixels.height, 66.0 / 25.4 * dpi, 1.0);
        // The last pixel may be covered in part.
        for (const int x : {0, pixels.width - 2}) {
            for (const int y : {0, pixels.height - 2}) EXPECT_TRUE(near(pixels.at(x, y), kaavi)) << x << ' ' << y;
        }
    }
    const PixelGrid pixels = render_pdf(path, 254);
    EXPECT_TRUE(near(pixels.at(730, 530), {255, 0, 0, 255})) << "the line at (70, 10) of a sheet of 60 mm";
    EXPECT_TRUE(near(pixels.at(135, 130), black)) << "and the dot at (10, 50)";
}

TEST_F(PressPdf, MarksLieOutsideOfTheTrimAndNothingElseDoes) {
    NEEDS("qpdf");
    NEEDS("pdftoppm");
    Print print = plain_print();
    print.style.ground = kaavi;
    print.press = {.bleed = 3.0, .marks = true};
    const auto path = write(print, [](PathSink& sink) {
        draw_sampler(sink);
        // Across the sheet and all that is around it.
        sink.begin_stroke({-20, 30}, Pen{});
        sink.lines(Points{{120, 30}});
        sink.end_stroke(false);
    });
    const PixelGrid pixels = render_pdf(path, 508);  // 20 pixels a millimetre; the sheet begins at 8 mm
    ASSERT_NEAR(pixels.width, 116 * 20, 1);
    ASSERT_NEAR(pixels.height, 76 * 20, 1);
    const auto at = [&](double x, double y) {
        return pixels.at(static_cast<int>(std::lround((x + 8) * 20)), static_cast<int>(std::lround((y + 8) * 20)));
    };
    EXPECT_TRUE(near(at(-2.5, -2.5), kaavi));
    EXPECT_TRUE(near(at(102.5, 62.5), kaavi));
    EXPECT_TRUE(near(at(-2.5, 30), black)) << "the line goes on into the bleed";
    EXPECT_TRUE(near(at(-3.5, 30), white)) << "and no further";
    EXPECT_TRUE(near(at(103.5, 30), white));
    EXPECT_TRUE(near(at(-3.5, -3.5), white));
    // 0.25 pt are 1.8 pixels.
    const auto darkest = [&](double x, double y) {
        int value = 255;
        for (int i = -2; i <= 2; ++i) {
            for (int k = -2; k <= 2; ++k) value = std::min<int>(value, at(x + i / 20.0, y + k / 20.0).green);
        }
        return value;
    };
    for (const double x : {-5.5, 105.5}) {
        for (const double y : {0.0, 60.0}) EXPECT_LT(darkest(x, y), 128) << x << ' ' << y;
    }
    for (const double x : {0.0, 100.0}) {
        for (const double y : {-5.5, 65.5}) EXPECT_LT(darkest(x, y), 128) << x << ' ' << y;
    }
    // Every dark pixel around the bleed is of a mark.
    for (int y = 0; y < pixels.height; ++y) {
        for (int x = 0; x < pixels.width; ++x) {
            const double right = (x + 0.5) / 20 - 8, down = (y + 0.5) / 20 - 8;
            if (right > -3.1 && right < 103.1 && down > -3.1 && down < 63.1) continue;
            if (pixels.at(x, y).green > 240) continue;
            const auto by = [](double place, double side) {
                return std::abs(place) < 0.15 || std::abs(place - side) < 0.15;
            };
            ASSERT_TRUE(by(right, 100) || by(down, 60)) << right << ' ' << down;
        }
    }
    const std::string text = plain_text(path);
    EXPECT_TRUE(has(text, "/Separation /All /DeviceGray"));
    EXPECT_TRUE(has(text, "/Registration CS 1 SCN 0.25 w "));
}

TEST_F(PressPdf, EveryColourGroundAndMarksAreALayerEach) {
    NEEDS("qpdf");
    Print print = plain_print();
    const std::string before = plain_text(write(print, draw_sampler));
    print.press = {.bleed = 3.0, .marks = true, .spots = {{"Red ink", {255, 0, 0, 255}}}};
    const std::string text = plain_text(write(print, draw_sampler));
    EXPECT_EQ(count_of(before, "/Type /OCG"), 7u);
    EXPECT_EQ(count_of(text, "/Type /OCG"), 8u);
    for (const std::string name :
         {"ground", "fills", "1 black", "2 red", "3 blue", "discs red", "discs blue", "marks"}) {
        EXPECT_EQ(count_of(text, "/Name (" + name + ")"), 1u) << name;
    }
    for (const std::string word : {"/Separation", "/ColorSpace", "marks"})
        EXPECT_EQ(count_of(before, word), 0u) << word;
}

TEST_F(PressPdf, NamesOfSpotColoursAreEscaped) {
    NEEDS("qpdf");
    Print print = plain_print();
    print.press.spots = parse_spots(std::vector<std::string>{"Rot (1/2)#=red", "காவி=black"});
    const auto path = write(print, draw_sampler);
    static_cast<void>(plain_text(path));
    const std::string text = contents(path);
    EXPECT_TRUE(has(text,
                    "[/Separation /Rot#20#281#2F2#29#23 /DeviceRGB << /FunctionType 2 /Domain [0 1] "
                    "/C0 [1 1 1] /C1 [1 0 0] /N 1 >>]"));
    EXPECT_TRUE(has(text, "[/Separation /#E0#AE#95#E0#AE#BE#E0#AE#B5#E0#AE#BF /DeviceRGB"));
}

TEST_F(PressPdf, SpotColoursLookAsTheColoursTheyAre) {
    NEEDS("pdftoppm");
    Print print = plain_print();
    print.style.palette[2].alpha = 128;
    const PixelGrid before = render_pdf(write(print, draw_sampler), 100);
    print.press.spots = parse_spots(std::vector<std::string>{"R=red", "B=blue", "K=black", "W=white"});
    const PixelGrid after = render_pdf(write(print, draw_sampler), 100);
    ASSERT_EQ(before.bytes.size(), after.bytes.size());
    for (std::size_t i = 0; i < before.bytes.size(); ++i) {
        const int difference =
            static_cast<unsigned char>(before.bytes[i]) - static_cast<unsigned char>(after.bytes[i]);
        ASSERT_LE(std::abs(difference), 2) << i;
    }
}

TEST_F(PressPdf, SpotColoursHavePlatesOfTheirOwn) {
    NEEDS("gs");
    NEEDS("oiiotool");
    Print print = plain_print();
    print.style.ground = kaavi;
    print.style.palette = {white, Colour{255, 0, 0, 255}, Colour{0, 0, 255, 128}};
    print.press = {.bleed = 3.0,
                   .marks = true,
                   .spots = parse_spots(std::vector<std::string>{"Kaavi=#b3452c", "White=white", "Sea=blue"})};
    const auto path = write(print, draw_sampler);
    const auto earth = plate(path, "Kaavi");
    const auto rice = plate(path, "White");
    const auto sea = plate(path, "Sea");
    const auto cyan = plate(path, "Cyan");
    const auto magenta = plate(path, "Magenta");
    ASSERT_TRUE(earth && rice && sea && cyan && magenta);
    // 5 pixels a millimetre; the sheet begins at 8 mm.
    const auto ink = [](const PixelGrid& pixels, double x, double y) {
        return 255 - pixels.at(static_cast<int>((x + 8) * 5), static_cast<int>((y + 8) * 5)).red;
    };
    EXPECT_EQ(ink(*earth, -2.5, -2.5), 255) << "the ground with its bleed";
    EXPECT_EQ(ink(*earth, 5, 5), 255);
    EXPECT_EQ(ink(*earth, -4, -4), 0) << "not beyond it";
    EXPECT_EQ(ink(*earth, 90, 30), 0) << "the white line is left out";
    EXPECT_EQ(ink(*rice, 90, 30), 255);
    EXPECT_EQ(ink(*rice, 5, 5), 0);
    EXPECT_EQ(ink(*earth, 70, 50), 0) << "and so is the red one";
    EXPECT_GT(ink(*magenta, 70, 50), 128);
    EXPECT_EQ(ink(*magenta, 5, 5), 0);
    EXPECT_EQ(ink(*rice, 70, 50), 0);
    EXPECT_NEAR(ink(*sea, 25, 40), 128, 2) << "a translucent square";
    EXPECT_NEAR(ink(*earth, 25, 40), 127, 2);
    EXPECT_EQ(ink(*sea, 5, 5), 0);
    for (const PixelGrid* one : {&*earth, &*rice, &*sea, &*cyan, &*magenta}) {
        int darkest = 0;
        for (const double y : {-0.2, 0.0}) darkest = std::max(darkest, ink(*one, -5.5, y));
        EXPECT_GT(darkest, 100) << "every plate has the marks";
    }
    EXPECT_FALSE(plate(path, "All"));
}

TEST_F(PressPdf, PartsOfASheetLieInsideAndTheGroundOfTheSheetAround) {
    NEEDS("qpdf");
    NEEDS("pdftoppm");
    Print print = plain_print();
    print.style.ground = kaavi;
    print.press = {.bleed = 3.0, .marks = true, .spots = {{"Kaavi", kaavi}}};
    Print part = plain_print();
    part.title = "Part";
    const auto path = folder_ / "parts.pdf";
    write_print(path, print, write_pdf, [&](PrintWriter& writer) {
        writer.begin_part(part, {10.0, 20.0, 30.0, 25.0, true});
        draw_sampler(writer);
    });
    const std::string text = plain_text(path);
    EXPECT_EQ(count_of(text, "/Type /OCG"), 9u) << "two grounds, the marks, and six layers of the drawing";
    EXPECT_EQ(count_of(text, "/Separation /Kaavi"), 1u);
    const PixelGrid pixels = render_pdf(path, 254);  // the sheet begins at 8 mm
    EXPECT_TRUE(near(pixels.at(52, 52), kaavi));
    EXPECT_TRUE(near(pixels.at(48, 48), white));
    EXPECT_TRUE(near(pixels.at(183, 283), white)) << "the ground of the part, in its corner";
    EXPECT_TRUE(near(pixels.at(178, 278), kaavi));
    EXPECT_TRUE(near(pixels.at(780, 580), kaavi)) << "its drawing is cut off";
}

TEST_F(PressPdf, TheSameBytesAndThePatternComesBack) {
    Print print = plain_print();
    print.pattern = "axiom: F\n; கோலம்\n";
    print.press = {.bleed = 3.0, .marks = true, .spots = {{"Black ink", black}, {"Red ink", {255, 0, 0, 255}}}};
    const auto path = write(print, draw_sampler);
    EXPECT_EQ(contents(path), contents(write(print, draw_sampler, "again.pdf")));
    const auto provenance = provenance_of(path);
    ASSERT_TRUE(provenance);
    EXPECT_EQ(provenance->pattern, print.pattern);
    EXPECT_EQ(provenance->made, print.made);
}

TEST_F(PressPdf, HugeSheetsKeepTheirMarksInTheirUnit) {
    NEEDS("qpdf");
    Print print = plain_print();
    print.page = {10'000.0, 5'000.0, 10.0};
    print.press = {.bleed = 100.0, .marks = true};
    const auto path = write(print, draw_sampler);
    static_cast<void>(plain_text(path));
    const std::string text = contents(path);
    EXPECT_TRUE(has(text, "/UserUnit 3\n"));
    EXPECT_NEAR(box(text, "/MediaBox ")[2], 10'210.0 * 72 / 25.4 / 3, 1e-4);
    EXPECT_TRUE(has(text, "SCN 0.0833 w "));
}

/// Whole drawings into files.
class PressDraw : public ::testing::Test {
protected:
    std::filesystem::path draw(const std::string& name, const Press& press, const std::string& style = "",
                               double dpi = 254.0) {
        const std::string text = "axiom: F\n" + style;
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern("test.lsys", text, diagnostics);
        const Grammar grammar = compile_grammar(pattern, diagnostics);
        Print print;
        print.page = {40.0, 20.0, 5.0};
        print.dpi = dpi;
        print.style = read_style(pattern, 300.0, diagnostics);
        diagnostics.throw_if_errors();
        print.press = press;
        DrawOptions options;
        options.format = print_format(name).value();
        sikku::draw(grammar, print, options, folder_ / name);
        return folder_ / name;
    }
    /// 3 channels, by another program.
    PixelGrid pixels(const std::filesystem::path& file, const std::string& channels = "0,0,0") {
        return read_by_oiiotool(file, channels, true);
    }

    ScratchFolder folder_;
};

TEST_F(PressDraw, PicturesAndSvgShowTheBleed) {
    NEEDS("oiiotool");
    for (const std::string name : {"a.png", "a.tif", "a.jpg"}) {
        const PixelGrid bled = pixels(draw(name, {.bleed = 3.0}, "ground: #b3452c\nstroke: 1mm white\n"), "0,1,2");
        EXPECT_EQ(bled.width, 460);
        EXPECT_EQ(bled.height, 260);
        for (const int x : {0, 459}) {
            for (const int y : {0, 259}) EXPECT_TRUE(near(bled.at(x, y), kaavi)) << name;
        }
        EXPECT_TRUE(near(bled.at(230, 130), white)) << name << ": the line is in the middle";
    }
    const std::string svg = contents(draw("a.svg", {.bleed = 3.0}));
    EXPECT_TRUE(has(svg, "width=\"46mm\""));
    EXPECT_TRUE(has(svg, "height=\"26mm\""));
}

TEST_F(PressDraw, OneBitIsBlackWhereHalfIsCovered) {
    NEEDS("oiiotool");
    NEEDS("tiffinfo");
    const std::string style = "ground: #ffe6b4\nstroke: 1.234mm #b3452c\n";
    const auto file = draw("a.tif", {.bits = 1}, style, 600.0);
    const std::string told = run_tool("tiffinfo '" + file.string() + "'").text;
    EXPECT_TRUE(has(told, "Bits/Sample: 1\n"));
    EXPECT_TRUE(has(told, "Photometric Interpretation: min-is-black"));
    EXPECT_TRUE(has(told, "600, 600 pixels/inch"));
    const PixelGrid bits = pixels(file);
    const PixelGrid grey = pixels(draw("grey.tif", {}, "ground: white\nstroke: 1.234mm black\n", 600.0));
    ASSERT_EQ(bits.bytes.size(), grey.bytes.size());
    int dark = 0;
    int between = 0;
    for (std::size_t i = 0; i < bits.bytes.size(); ++i) {
        const int level = static_cast<unsigned char>(grey.bytes[i]);
        ASSERT_EQ(static_cast<unsigned char>(bits.bytes[i]), level < 128 ? 0 : 255) << i;
        dark += level < 128 ? 1 : 0;
        between += level > 0 && level < 255 ? 1 : 0;
    }
    EXPECT_GT(dark, 3 * 1000);
    EXPECT_GT(between, 3 * 100);
    // A white line on earth is the other way round.
    const PixelGrid light = pixels(draw("light.tif", {.bits = 1}, "ground: #b3452c\nstroke: 1mm white\n", 600.0));
    EXPECT_EQ(light.at(0, 0), black);
    EXPECT_EQ(light.at(light.width / 2, light.height / 2), white);
}

TEST_F(PressDraw, OneBitWithoutGroundIsOnPaper) {
    NEEDS("oiiotool");
    const PixelGrid bits = pixels(draw("a.tif", {.bits = 1}, "ground: none\n", 600.0));
    EXPECT_EQ(bits.at(0, 0), white);
    EXPECT_EQ(bits.at(bits.width / 2, bits.height / 2), black);
}

}  // namespace sikku::press_test
