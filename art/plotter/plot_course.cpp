#include "art/plotter/plot_course.h"

#include <cstddef>

namespace sikku {
namespace {

/// Lengths are sums of many roundings.
constexpr double slack = 1 + 1e-9;

class Follower {
public:
    Follower(const PlotCourse& course, const Monitor& monitor, const std::function<void(const PlotPiece&)>& visit)
        : course_(course), pulse_(monitor), visit_(visit) {}

    void follow(const PlotLayer& layer) {
        refill_ = layer.settings.refill ? layer.settings.refill : course_.refill;
        is_filled_ = false;
        for (const PlotStroke& stroke : layer.strokes.strokes) follow(layer, stroke);
    }
    double length() const { return length_; }

private:
    void follow(const PlotLayer& layer, const PlotStroke& stroke) {
        pulse_();
        const auto ends = layer.strokes.ends(stroke);
        if (course_.split <= 0 && course_.resume <= 0 && !refill_) {
            return visit_({layer, ends, stroke.closed});
        }
        std::vector<double> lengths;
        double rest = 0;  // rest of the stroke
        for (const PlotEnd end : ends) {
            pulse_();
            lengths.push_back(course_.step * layer.graph.length(end));
            rest += lengths.back();
        }
        std::size_t begin = 0;
        double piece = 0;
        const auto finish = [&](std::size_t end) {
            if (end > begin)
                visit_({layer, ends.subspan(begin, end - begin), stroke.closed && end - begin == ends.size()});
            begin = end;
            piece = 0;
        };
        for (std::size_t i = 0; i < ends.size(); ++i) {
            pulse_();
            const double more = lengths[i];
            length_ += more;
            if (length_ <= course_.resume) {
                begin = i + 1;
                rest -= more;
                continue;
            }
            if (i > begin && course_.split > 0 && piece + more > course_.split) finish(i);
            if (refill_) {
                const double most = refill_->length * slack;
                const double wanted = i == begin && rest <= most ? rest : more;
                if (!is_filled_ || used_ + wanted > most) {
                    finish(i);
                    visit_({layer, {}, false, refill_->place});
                    is_filled_ = true;
                    used_ = 0;
                }
                used_ += more;
            }
            piece += more;
            rest -= more;
        }
        finish(ends.size());
    }

    const PlotCourse& course_;
    Pulse pulse_;
    const std::function<void(const PlotPiece&)>& visit_;
    std::optional<Refill> refill_;
    bool is_filled_ = false;
    double used_ = 0;
    double length_ = 0;
};

}  // namespace

double follow_course(std::span<const std::unique_ptr<PlotLayer>> layers, const PlotCourse& course,
                     const Monitor& monitor, const std::function<void(const PlotPiece&)>& visit) {
    Follower follower(course, monitor, visit);
    for (const auto& layer : layers) follower.follow(*layer);
    return follower.length();
}

}  // namespace sikku
