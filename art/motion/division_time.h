// art/motion/division_time.h: times of the division of tiles, and motions of their parts.
#pragma once

#include <span>

namespace sikku {

/// Display times of generations of tiles that divide, in seconds.
struct DivisionTimes {
    double rest = 0.6;      ///< pause at each generation
    double division = 1.4;  ///< duration of each division
    double hold = 2.0;      ///< minimum pause at the last generation
    double fade = 0.8;      ///< fade from the last generation to the first, before the animation repeats
};

/// A value at a share of a division's time, 0 to 1.
struct Keyframe {
    double at, value;
};
/// Keys in the order of time, from 0 to 1. Between two of them values change slowly, fast, slowly: by the cubic
/// Bézier 1/3 0 2/3 1, which is 3 t^2 - 2 t^3.
using Track = std::span<const Keyframe>;

double value_at(Track track, double share);
double eased(double share);

/// Key frames of parts of tiles, which appear, come apart and settle.
struct DivisionTracks {
    Track size;     ///< size of a part, about its middle
    Track way;      ///< share of DivisionStage::Part::way by which a part is moved
    Track outline;  ///< width of its outline
    Track colour;   ///< mix of the colour of its parent, 0, and its own, 1
    Track opacity;  ///< opacity of parts
    Track before;   ///< opacity of the generation before
    Track arrival;  ///< opacity of lines and discs of this generation, besides outlines
};

/// Way in which parts emerge from their parents: they are cut out of them; they appear in their places, across the
/// edges of their parents; or they spread out of them, where the places of parents and parts agree only roughly.
enum class DivisionKind { cut, across, spread };

const DivisionTracks& division_tracks(DivisionKind kind);

/// Times of one repetition of generations that divide one after the other.
class DivisionClock {
public:
    /// @param generations  at least 2
    DivisionClock(int generations, const DivisionTimes& times) : generations_(generations), times_(times) {}

    /// Time at which the tiles of a generation begin to appear; 0 for the first, number 0.
    double begin(int generation) const {
        return generation == 0 ? 0 : generation * times_.rest + (generation - 1) * times_.division;
    }
    /// Time at which its tiles have come to rest.
    double rest(int generation) const { return generation == 0 ? 0 : begin(generation) + times_.division; }
    /// Time at which the last generation begins to fade into the first.
    double fade() const;
    double total() const { return fade() + times_.fade; }
    int generations() const { return generations_; }
    const DivisionTimes& times() const { return times_; }

private:
    int generations_;
    DivisionTimes times_;
};

}  // namespace sikku
