// art/vector/eps.cpp: writes a drawing as Encapsulated PostScript.
#include "art/print/recipe_comments.h"
#include "art/style/contrast.h"
#include "art/vector/operator_writer.h"
#include "art/vector/vector_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace sikku {
namespace {

/// Printers of level 2 support paths of 1,500 points.
constexpr int most_eps_points = 1000;

/// A text of a comment: printable ASCII, at most 200 characters.
std::string comment_text(std::string_view text) {
    std::string result(text.substr(0, 200));
    std::replace_if(
        result.begin(), result.end(), [](char byte) { return byte < 0x20 || byte >= 0x7F; }, '?');
    return result;
}

class EpsWriter final : public OperatorWriter<OperatorLayer> {
public:
    EpsWriter(const Print& print, Output& file) : OperatorWriter(print, file, most_eps_points) {
        write_head();
        write_ground(print.style.ground, window_);
        begin_layers();
    }

    void begin_part(const Print& part, const Window& window) override {
        end_part();
        take_part(part, window);
        file_.write(fmt::format("gsave % {}\n", comment_text(part.title)));
        if (window.clips) file_.write(rectangle(window) + " rectclip\n");
        has_part_ = true;
        write_ground(part.style.ground, window);
        begin_layers();
    }

    void finish() override {
        end_part();
        file_.write("grestore end\nshowpage\n%%Trailer\n%%EOF\n");
    }

private:
    void write_head() {
        const double width = print_.page.width * 1000.0 * points_of_micrometre;
        const double height = print_.page.height * 1000.0 * points_of_micrometre;
        file_.write(fmt::format("%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 {} {}\n%%HiResBoundingBox: 0 0 {} {}\n",
                                static_cast<std::int64_t>(std::ceil(width)),
                                static_cast<std::int64_t>(std::ceil(height)), decimal(width, 4), decimal(height, 4)));
        if (!print_.title.empty()) file_.write(fmt::format("%%Title: {}\n", comment_text(print_.title)));
        file_.write("%%Creator: Sikku\n%%LanguageLevel: 2\n%%DocumentData: Clean7Bit\n%%EndComments\n");
        for (const std::string& piece : recipe_comments(print_.pattern, print_.made)) file_.write("%" + piece + "\n");
        file_.write(
            "%%BeginProlog\n/SikkuDict 16 dict def SikkuDict begin\n/m /moveto load def /l /lineto load def\n"
            "/c /curveto load def /h /closepath load def\n/S /stroke load def /f /fill load def\n"
            "/w /setlinewidth load def /k /setrgbcolor load def\nend\n%%EndProlog\n");
        const std::string scale = decimal(points_of_micrometre, 14);
        file_.write(fmt::format(
            "SikkuDict begin gsave\n0 0 {0} {1} rectclip\n[{2} 0 0 -{2} 0 {1}] concat\n1 setlinejoin 1 setlinecap\n",
            decimal(width, 4), decimal(height, 4), scale));
    }

    static std::string rectangle(const Window& window) {
        return fmt::format("{} {} {} {}", decimal(window.left * 1000, 1), decimal(window.top * 1000, 1),
                           decimal(window.width * 1000, 1), decimal(window.height * 1000, 1));
    }

    void write_ground(const std::optional<Colour>& ground, const Window& window) {
        if (!ground || ground->alpha == 0) return;
        // Beneath the ground of a part lies that of the sheet.
        const Colour beneath = part_ == &print_ ? white : laid_over(print_.style.ground.value_or(white), white);
        paper_ = laid_over(*ground, beneath);
        file_.write(fmt::format("% ground\n{} {} rectfill\n", set(paper_), rectangle(window)));
    }

    /// The operators that set an opaque colour.
    static std::string set(Colour colour) {
        return fmt::format("{} {} {} k", decimal(colour.red / 255.0, 4), decimal(colour.green / 255.0, 4),
                           decimal(colour.blue / 255.0, 4));
    }

    void end_part() {
        write_layers([](OperatorLayer& layer) { end_path(layer); });
        if (has_part_) file_.write("grestore\n");
        has_part_ = false;
        paper_ = laid_over(print_.style.ground.value_or(white), white);
    }

    void begin_layer(OperatorLayer& layer, LayerOrder order, Colour colour) override {
        take_layer(layer);
        layer.text.append("% " + label_of(order, colour) + "\n");
    }
    std::string ink_of(LayerKind, Colour colour) override { return set(laid_over(colour, paper_)); }

    static constexpr Colour white{255, 255, 255, 255};
    Colour paper_ = white;  ///< colour with which translucent colours are mixed
    bool has_part_ = false;
};

}  // namespace

std::unique_ptr<PrintWriter> write_eps(const Print& print, Output& file) {
    return std::make_unique<EpsWriter>(print, file);
}

}  // namespace sikku
