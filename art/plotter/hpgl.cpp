#include "art/plotter/hpgl.h"

#include "art/print/micrometres.h"

#include <fmt/format.h>

#include <iterator>
#include <string>

namespace sikku {
namespace {

constexpr double units_of_millimetre = 40.0;
/// Rounding moves a point by up to 0.71 units: this much is left for chords.
constexpr double chord_tolerance = 0.28 / units_of_millimetre;
/// Plotters keep an instruction in a small memory.
constexpr std::size_t longest_instruction = 200;

using Units = glm::ivec2;

class Writer final : public PlotWriter {
public:
    Writer(const Print& print, Output& file) : PlotWriter(print), file_(file) { file_.write("IN;\n"); }

    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        here_ = start;
        if (number(pen) != pen_) {
            pen_ = number(pen);
            file_.write(fmt::format("PU;SP{};\n", pen_));
        }
        started_ = false;
    }
    void lines(std::span<const glm::dvec2> ends) override {
        start();
        for (const glm::dvec2 end : ends) to(on_page(here_ = end));
    }
    void curves(std::span<const glm::dvec2> controls) override {
        start();
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            const Bezier bezier = {on_page(here_), on_page(controls[i]), on_page(controls[i + 1]),
                                   on_page(controls[i + 2])};
            const int count = chords(bezier, chord_tolerance);
            for (int k = 1; k < count; ++k) to(at(bezier, static_cast<double>(k) / count));
            to(bezier[3]);
            here_ = controls[i + 2];
        }
    }
    void end_stroke(bool) override {
        if (!started_) return;
        if (!moved_) put(at_);  // a dot
        end_instruction();
        started_ = false;
    }
    void finish() override { file_.write("PU;SP0;\n"); }

private:
    /// Only when something is drawn: a stroke may change its pen before.
    void start() {
        if (started_) return;
        started_ = true;
        moved_ = false;
        at_ = rounded(on_page(here_));
        file_.write(fmt::format("PU{},{};\n", at_.x, at_.y));
    }

    Units rounded(glm::dvec2 millimetres) const {
        require_on_page(millimetres);
        return {to_whole(millimetres.x * units_of_millimetre), to_whole(millimetres.y * units_of_millimetre)};
    }

    void to(glm::dvec2 millimetres) {
        const Units next = rounded(millimetres);
        if (next == at_) return;
        at_ = next;
        moved_ = true;
        put(next);
    }

    void put(Units point) {
        fmt::format_to(std::back_inserter(instruction_), "{}{},{}", instruction_.empty() ? "PD" : ",", point.x,
                       point.y);
        if (instruction_.size() > longest_instruction) end_instruction();
    }

    void end_instruction() {
        if (instruction_.empty()) return;
        file_.write(instruction_ + ";\n");
        instruction_.clear();
    }

    Output& file_;
    int pen_ = 0;
    bool started_ = false;  // the pen is down
    bool moved_ = false;    // and has drawn something
    Units at_{0};           // where the pen is
    std::string instruction_;
};

}  // namespace

std::unique_ptr<PlotWriter> write_hpgl(const Print& print, Output& file) {
    return std::make_unique<Writer>(print, file);
}

}  // namespace sikku
