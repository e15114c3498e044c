#include "art/cutting/piece_drawing.h"

#include "art/drawing/drawing.h"
#include "art/image/image_file.h"
#include "art/tiles/united_lines.h"
#include "art/vector/pdf.h"
#include "art/writer/draw.h"
#include "engine/geometry/lettering.h"

#include <fmt/format.h>

#include <memory>

namespace sikku {
namespace {

constexpr Pen label_pen{.width = 0.7, .colour = 0};
constexpr Pen seam_pen{.colour = 1};
constexpr Pen cut_pen{.colour = 2};
constexpr std::size_t most_cuts = 20'000'000;

class PieceDrawing : public Drawing {
public:
    PieceDrawing(const std::vector<PieceShape>& shapes, const PieceSheet& sheet, const Style& style,
                 const PieceWriting& writing)
        : Drawing(writing.drawing, writing.drawing.reading()),
          shapes_(shapes),
          sheet_(sheet),
          style_(style),
          shares_cuts_(writing.shares_cuts),
          extent_{{{0, 0}, {sheet.page.width, sheet.page.height}}, style.stroke.value} {}

    const DrawnExtent& seen() override { return extent_; }
    const Style& style() const override { return style_; }
    double scale() const override { return 1; }
    using Drawing::read;
    void read(const Print&, const Window&, PathSink& sink) const override {
        for (const auto& [text, place] : sheet_.headings) {
            write_text(text, place.start, place.height, label_pen, sink);
        }
        for (const auto& [shape, at] : sheet_.pieces) {
            const auto& [start, height] = shapes_[shape].place;
            if (height > 0) write_text(shapes_[shape].label, start + at, height, label_pen, sink);
        }
        for (const auto& [shape, at] : sheet_.pieces) draw_dashed(shapes_[shape].seam, at, seam_pen, sink);
        if (shares_cuts_) return draw_shared_cuts(sink);
        for (const auto& [shape, at] : sheet_.pieces) draw_closed(shapes_[shape].cut, at, cut_pen, sink);
    }

private:
    void draw_shared_cuts(PathSink& sink) const {
        UnitedLines united(static_cast<double>(most_cuts));
        for (const auto& [shape, at] : sheet_.pieces) {
            const std::vector<glm::dvec2>& cut = shapes_[shape].cut;
            for (std::size_t i = 0; i < cut.size(); ++i) {
                united.add_line(cut[i] + at, cut[(i + 1) % cut.size()] + at, cut_pen);
            }
        }
        draw_lines(united.unite(UnitedLines::Kept::all, reading_.monitor).lines, sink, reading_.monitor);
    }

    const std::vector<PieceShape>& shapes_;
    const PieceSheet& sheet_;
    const Style& style_;
    bool shares_cuts_;
    DrawnExtent extent_;
};

Print print_of(const PieceSheet& sheet, const PieceWriting& writing) {
    Print print;
    print.page = sheet.page;
    // Millimetres from the bottom left corner become those from the top left corner.
    print.placement.to_page = glm::dmat3x2(1, 0, 0, -1, 0, sheet.page.height);
    print.style.stroke.value = 0.25;
    print.style.palette = {{255, 0, 0, 255}, {0, 0, 255, 255}, {0, 0, 0, 255}};
    const int label = label_pen.colour, seam = seam_pen.colour, cut = cut_pen.colour;
    print.style.cut_layers = {{label, "LABEL"}, {seam, "SEAM"}, {cut, "CUT"}};
    print.layer_names = {{label, "label"}, {seam, "seam"}, {cut, "cut"}};
    if (info(writing.drawing.format).kind == FormatKind::pixels) print.style.ground = Colour{255, 255, 255, 255};
    print.dpi = writing.dpi;
    print.title = writing.title;
    print.pattern = writing.pattern;
    print.made = writing.made;
    return print;
}

void write_pages(const std::vector<std::unique_ptr<PieceDrawing>>& drawings, const std::vector<Print>& prints,
                 Output& output) {
    const auto writer = write_pdf_pages(prints.front(), output);
    for (std::size_t i = 0; i < drawings.size(); ++i) {
        writer->begin_page(prints[i], whole_page(prints[i].page), {0, 0}, 1);
        drawings[i]->read(prints[i], *writer);
    }
    writer->finish();
}

}  // namespace

bool has_several_files(const PieceWriting& writing) {
    return writing.drawing.format != PrintFormat::pdf || writing.drawing.plot;
}

std::vector<std::filesystem::path> sheet_files(const std::filesystem::path& file, std::size_t count) {
    if (count == 1) return {file};
    std::vector<std::filesystem::path> files;
    for (std::size_t i = 1; i <= count; ++i) {
        files.push_back(file);
        files.back().replace_filename(fmt::format("{}-{:0{}}{}", file.stem().string(), i,
                                                  fmt::formatted_size("{}", count), file.extension().string()));
    }
    return files;
}

std::vector<DrawReport> write_pieces(const std::vector<PieceShape>& shapes, const std::vector<PieceSheet>& sheets,
                                     const PieceWriting& writing, const std::filesystem::path& file,
                                     Destination& destination) {
    const PrintFormat format = writing.drawing.format;
    if (uses_image_module(format)) prepare_images(writing.drawing.threads);
    std::vector<Print> prints;
    for (const PieceSheet& sheet : sheets) prints.push_back(print_of(sheet, writing));
    std::vector<std::unique_ptr<PieceDrawing>> drawings;
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        drawings.push_back(std::make_unique<PieceDrawing>(shapes, sheets[i], prints[i].style, writing));
    }
    std::vector<DrawReport> reports(sheets.size());
    std::vector<std::unique_ptr<Output>> outputs;
    if (sheets.size() > 1 && !has_several_files(writing)) {
        outputs.push_back(destination.open(file));
        write_pages(drawings, prints, *outputs.back());
    } else {
        const std::vector<std::filesystem::path> files = sheet_files(file, sheets.size());
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            outputs.push_back(destination.open(files[i]));
            draw_placed(*drawings[i], prints[i], writing.drawing, *outputs.back(), files[i], reports[i]);
        }
    }
    for (const auto& output : outputs) output->commit();
    return reports;
}

}  // namespace sikku
