#include "tests/print_tools.h"

namespace sikku {

PixelGrid read_ppm(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    PixelGrid pixels;
    std::string magic;
    int most = 0;
    stream >> magic >> pixels.width >> pixels.height >> most;
    stream.get();
    std::ostringstream text;
    text << stream.rdbuf();
    pixels.bytes = text.str();
    return pixels;
}

namespace {

PixelGrid converted(const std::filesystem::path& file, const std::string& channels, bool is_raw) {
    const std::string picture = file.string() + ".ppm";
    const ToolOutcome outcome = run_tool(std::string("oiiotool ") + (is_raw ? "--iconfig oiio:RawColor 1 '" : "'") +
                                         file.string() + "' --ch " + channels + " -d uint8 -o '" + picture + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
    return read_ppm(picture);
}

/// OpenImageIO 2.5 writes PPM upside down.
bool oiiotool_turns_ppm() {
    static const bool turns = [] {
        const ScratchFolder folder;
        // Red above blue, from the bottom up.
        const std::string bmp(
            "BM\x3e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\2\0\0\0\1\0\x18\0\0\0\0\0\x08\0\0\0"
            "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\xff\0\0\0\0\0\xff\0",
            62);
        return converted(folder.write("turned.bmp", bmp), "R,G,B", false).at(0, 0).blue == 255;
    }();
    return turns;
}

}  // namespace

PixelGrid read_by_oiiotool(const std::filesystem::path& file, const std::string& channels, bool is_raw) {
    PixelGrid grid = converted(file, channels, is_raw);
    if (!oiiotool_turns_ppm()) return grid;
    const std::size_t stride = 3 * static_cast<std::size_t>(grid.width);
    std::string turned;
    for (std::size_t end = grid.bytes.size(); end >= stride && stride > 0; end -= stride) {
        turned += grid.bytes.substr(end - stride, stride);
    }
    grid.bytes = std::move(turned);
    return grid;
}

std::string pdf_complaints(const std::filesystem::path& pdf) {
    const ToolOutcome outcome = run_tool("qpdf --check '" + pdf.string() + "'");
    return outcome.ok && outcome.text.find("WARNING") == std::string::npos ? "" : outcome.text;
}

std::string plain_text(const std::filesystem::path& pdf) {
    EXPECT_EQ(pdf_complaints(pdf), "");
    const std::string plain = pdf.string() + ".plain";
    const ToolOutcome outcome = run_tool("qpdf --stream-data=uncompress '" + pdf.string() + "' '" + plain + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
    return contents(plain);
}

PixelGrid render_pdf(const std::filesystem::path& pdf, int dpi) {
    const std::string stem = pdf.string() + ".page";
    const ToolOutcome outcome =
        run_tool("pdftoppm -r " + std::to_string(dpi) + " -singlefile '" + pdf.string() + "' '" + stem + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
    EXPECT_EQ(outcome.text, "");
    return read_ppm(stem + ".ppm");
}

::testing::AssertionResult near(Colour actual, Colour expected, int tolerance) {
    const auto far = [&](int a, int b) { return std::abs(a - b) > tolerance; };
    if (far(actual.red, expected.red) || far(actual.green, expected.green) || far(actual.blue, expected.blue)) {
        return ::testing::AssertionFailure() << hex(actual) << " is not " << hex(expected);
    }
    return ::testing::AssertionSuccess();
}

Print plain_print() {
    Print print;
    print.page = {100.0, 60.0, 5.0};
    print.style.stroke = {2.0, false};
    print.style.ground = Colour{255, 255, 255, 255};
    print.style.palette = {Colour{0, 0, 0, 255}, Colour{255, 0, 0, 255}, Colour{0, 0, 255, 255}};
    Box box;
    box.add({0.0, 0.0});
    box.add({100.0, 60.0});
    PlacementOptions options{.step = 1.0};
    print.placement = place(box, print.page, options, 0.0, 0.0);
    print.title = "A test";
    print.pattern = "axiom: F\n";
    print.made = "sikku 0.1.0, -n 4";
    return print;
}

std::optional<Provenance> provenance_of(const std::filesystem::path& file) {
    try {
        return read_provenance(file);
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

void draw_sampler(PathSink& sink) {
    using Points = std::vector<glm::dvec2>;
    const Pen black;
    Pen red{.colour = 1};
    Pen blue{.colour = 2};
    sink.begin_stroke({10, 10}, red);
    sink.lines(Points{{90, 10}});
    sink.disc({50, 10}, 3.0, blue);
    sink.change_pen(black);
    sink.lines(Points{{90, 50}});
    sink.end_stroke(false);
    sink.polygon(Points{{20, 5}, {40, 5}, {40, 25}, {20, 25}}, blue);
    sink.polygon(Points{{30, 15}, {50, 15}, {50, 35}, {30, 35}}, red);
    sink.begin_stroke({60, 30}, blue);
    sink.curves(Points{{60, 45}, {80, 45}, {80, 30}});
    sink.curves(Points{{80, 15}, {60, 15}, {60, 30}});
    sink.end_stroke(true);
    sink.begin_stroke({10, 50}, black);
    sink.lines(Points{{10, 50}});
    sink.end_stroke(true);
    sink.disc({20, 50}, 0.0, red);
}

void draw_square(PathSink& sink, const Pen& first, const Pen& others) {
    using Points = std::vector<glm::dvec2>;
    sink.begin_stroke({10, 10}, first);
    sink.lines(Points{{10, 50}});
    sink.change_pen(others);
    sink.lines(Points{{50, 50}, {50, 10}, {10, 10}});
    sink.end_stroke(true);
}

std::string without_recipe(const std::string& format, std::string text) {
    const auto cut = [&](const std::string& begin, const std::string& end) {
        for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos;) {
            const std::size_t to = text.find(end, at + begin.size());
            text.erase(at, to == std::string::npos ? to : to - at);
        }
    };
    if (format == "svg") cut("<metadata>", "</metadata>");
    if (format == "pdf") text = text.substr(0, text.rfind("/Subject "));
    if (format == "eps") cut("%sikku", "\n");
    if (format == "gcode") cut("(", "\n");
    if (format == "gcode") cut(";", "\n");
    if (format == "hpgl") text = text.substr(0, text.find("CO\""));
    if (format == "dxf") cut("999\n", "\n");
    if (format == "obj" || format == "mtl") cut("#", "\n");
    return text;
}

}  // namespace sikku
