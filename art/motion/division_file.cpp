#include "art/motion/division_file.h"

#include "art/drawing/framed_drawing.h"
#include "art/motion/division_drawing.h"
#include "art/motion/division_style.h"
#include "art/motion/gif_file.h"
#include "art/vector/svg.h"
#include "art/writer/make_drawing.h"
#include "engine/geometry/moved_path.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr double frame_seconds = 0.04;

/// A moment with the frame of the print around it.
std::unique_ptr<Drawing> framed(std::shared_ptr<const Division> division, const DivisionMoment& moment,
                                const Style& style, const DrawOptions& options) {
    const Reading reading = options.reading();
    auto drawing = std::make_unique<DivisionDrawing>(std::move(division), moment, options, reading);
    return with_frame(std::move(drawing), style, options, reading);
}

/// Draws only the frame of a print.
class EmptyDrawing : public Drawing {
public:
    EmptyDrawing(const Division& division, const DrawOptions& options)
        : Drawing(options, options.reading()), division_(division) {}
    const DrawnExtent& seen() override { return division_.seen; }
    const Style& style() const override { return division_.style; }
    double scale() const override { return division_.scale; }
    using Drawing::read;
    void read(const Print&, const Window&, PathSink&) const override {}

private:
    const Division& division_;
};

class DivisionFile {
public:
    DivisionFile(std::shared_ptr<const Division> division, const Print& print, const DrawOptions& options,
                 const DivisionTimes& times)
        : division_(std::move(division)),
          given_(print),
          options_(options),
          clock_(static_cast<int>(division_->stages.size()), times) {}

    DrawReport write_gif(Output& output, const std::filesystem::path& file) {
        const std::size_t stages = division_->stages.size();
        const std::size_t moving = (stages - 1) * static_cast<std::size_t>(frames_between(clock_.times().division)) +
                                   static_cast<std::size_t>(frames_between(clock_.times().fade));
        GifFile gif(given_, options_, stages + moving, output, file);
        for (std::size_t i = 0; i < division_->stages.size(); ++i) {
            const bool is_last = i + 1 == division_->stages.size();
            if (i > 0)
                add_frames(gif, clock_.times().division, [i](double share) { return DivisionMoment{i, share}; });
            add_frame(gif, {i}, is_last ? clock_.fade() - clock_.rest(static_cast<int>(i)) : clock_.times().rest);
        }
        const std::size_t last = division_->stages.size() - 1;
        add_frames(gif, clock_.times().fade, [last](double share) { return DivisionMoment{last, 1, share}; });
        gif.close();
        return report_;
    }

    DrawReport write_svg(Output& output) {
        auto frame = std::unique_ptr<Drawing>(std::make_unique<EmptyDrawing>(*division_, options_));
        const bool is_framed = has_frame(given_.style, options_);
        frame = with_frame(std::move(frame), given_.style, options_, options_.reading());
        Print print = given_;
        report_ = frame->place(print);
        print.style = division_->style;
        print.style_sheet = division_style(*division_, clock_, print.placement);
        const auto writer = sikku::write_svg(print, output);
        std::vector<Print> parts(division_->stages.size(), print);
        std::vector<PartMotion> motions;
        motions.reserve(parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
            options_.monitor.check();
            const DivisionStage& stage = division_->stages[i];
            Print& part = parts[i];
            part.style.ground.reset();
            part.title = fmt::format("n = {}", stage.steps);
            part.placement = stage_placement(stage, print.placement);
            motions.push_back(stage_motion(*division_, i, print.placement));
            part.motion = &motions.back();
            writer->begin_part(part, whole_page(print.page));
            OnlyPolygons polygons(*writer);
            stage.picture.draw(polygons);
            if (!stage.has_more_lines) continue;
            WithoutPolygons lines(*writer);
            stage.picture.draw(lines);
        }
        if (is_framed) {
            Print around = print;
            around.style = frame->style();
            around.style.ground.reset();
            around.title = "frame";
            writer->begin_part(around, whole_page(print.page));
            frame->read(around, *writer);
            writer->finish();
        } else {
            writer->finish();
        }
        return report_;
    }

private:
    /// Number of pictures within a motion, without the first and the last.
    static int frames_between(double seconds) {
        return std::max(0, static_cast<int>(std::lround(seconds / frame_seconds)) - 1);
    }
    template <class MomentAt>
    void add_frames(GifFile& gif, double seconds, MomentAt&& moment_at) {
        const int count = frames_between(seconds);
        for (int frame = 1; frame <= count; ++frame) {
            add_frame(gif, moment_at(static_cast<double>(frame) / (count + 1)), frame_seconds);
        }
    }
    void add_frame(GifFile& gif, const DivisionMoment& moment, double seconds) {
        Print print = given_;
        const auto drawing = framed(division_, moment, print.style, options_);
        report_ = drawing->place(print);
        print.style = drawing->style();
        gif.frame(*drawing, print, seconds);
    }

    std::shared_ptr<const Division> division_;
    const Print& given_;
    const DrawOptions& options_;
    DivisionClock clock_;
    DrawReport report_;
};

}  // namespace

DrawReport draw_division(const Grammar& grammar, const Print& print, const DrawOptions& given_options,
                         const DivisionOptions& division, const std::filesystem::path& file,
                         Destination& destination) {
    const DrawOptions options = with_locked_watch(given_options);
    if (print.style.line == Line::spline) throw DivisionError("tiles that divide have straight edges, not splines");
    if (print.style.hand > 0) throw DivisionError("tiles that divide are not drawn by hand");
    auto stages = std::make_shared<const Division>(
        make_division(grammar, print.style, options, options.reading(), division.first, division.last,
                      division.is_gif ? most_tiles_of_gif : most_tiles_of_svg));
    const auto output = destination.open(file);
    const Print placed = division.is_gif ? print : as_picture(print);
    const DrawOptions drawing = division.is_gif ? for_frames(options) : options;
    DivisionFile animation(std::move(stages), placed, drawing, division.times);
    DrawReport report = division.is_gif ? animation.write_gif(*output, file) : animation.write_svg(*output);
    output->commit();
    return report;
}

}  // namespace sikku
