#include "engine/geometry/recorded_path.h"

namespace sikku {

void RecordedPath::draw(PathSink& sink) const {
    std::span<const glm::dvec2> left(points_);
    for (const Recorded& recorded : calls_) {
        const auto points = left.first(recorded.points);
        left = left.subspan(recorded.points);
        switch (recorded.call) {
            case Call::begin:
                sink.begin_stroke(points.front(), recorded.pen);
                break;
            case Call::lines:
                sink.lines(points);
                break;
            case Call::curves:
                sink.curves(points);
                break;
            case Call::pen:
                sink.change_pen(recorded.pen);
                break;
            case Call::end:
            case Call::close:
                sink.end_stroke(recorded.call == Call::close);
                break;
            case Call::polygon:
                sink.polygon(points, recorded.pen);
                break;
            case Call::area:
                sink.area(points, recorded.pen);
                break;
            case Call::disc:
                sink.disc(points.front(), left.front().x, recorded.pen);
                left = left.subspan(1);
                break;
            case Call::mark:
                sink.mark();
                break;
        }
    }
}

}  // namespace sikku
