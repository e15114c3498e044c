// art/hand/hand.h: makes lines waver and swell, as if drawn with rice flour by hand.
#pragma once

#include "art/hand/hand_line.h"
#include "engine/base/monitor.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

struct HandOptions {
    double strength = 0.4;   ///< above 0 and at most 1
    std::uint64_t seed = 0;  ///< seed of all random choices
    Monitor monitor = {};    ///< polled
};

/// A place where two lines cross, with half the width of the narrower one: flour lies on flour there.
struct HandCrossing {
    glm::dvec2 at{0.0};
    double half = 0;
    std::size_t line = 0, node = 0;  ///< one of the two lines, and its last node before the place
    std::size_t other = 0, other_node = 0;
};

/// Moves the nodes of lines and sets their widths, in turtle steps.
///
/// - Lines drift with the whole ground, in waves about two loops long that move neighbours and dots together,
///   sway along their course, in waves about a loop long, and tremble slightly.
/// - The hand slows in bends, where more flour falls. The speed of hands is proportional to the cube root of the
///   radius (Lacquaniti, Terzuolo & Viviani 1983); the cross-section of a heap of flour is inversely proportional to
///   speed, and its width to the root of that. The width also pulses with the fingers.
/// - A pinch of flour lasts some loops (see Pinches). Towards its end there is less flour, and the line is narrower.
/// - Loops differ in size, so that the images of a motif are not equal.
/// - Neighbouring lines keep their distance: sway, swell and drift together take less than the gap between two lines
///   that run side by side, so that lines that do not touch never do. Lines that cross still cross.
///
/// - Fills and dots move with the ground, those at a line with the line.
///
/// Cost: about 3 µs a node. Memory: 300 bytes a node. @throws what the monitor throws
void draw_by_hand(std::vector<HandLine>& lines, std::vector<HandDot>& dots, std::vector<HandFill>& fills,
                  const HandOptions& options);

/// Finds where lines cross. Cost: O(n).
std::vector<HandCrossing> hand_crossings(const std::vector<HandLine>& lines);

/// The line as a hand draws it from start to end. A closed line overlaps its start by a few widths, thins there and
/// misses it slightly.
HandLine drawn_stroke(const HandLine& line, const HandOptions& options);

/// The outline of a part of an open line, from one node to another, with blunt round ends, as Béziers for
/// PathSink::area(). Its winding number is not 0 anywhere inside.
std::vector<glm::dvec2> hand_outline(const HandLine& stroke, std::size_t from, std::size_t to);

/// The middle of a line as Béziers, three controls for each, from its first node.
std::vector<glm::dvec2> hand_middle(const HandLine& line);

/// The outline of a dot: a small heap, not quite round.
std::vector<glm::dvec2> dot_outline(const HandDot& dot, std::uint64_t number, const HandOptions& options);

/// The heaps of flour of which a dot consists: one in its middle and some smaller ones, within its radius.
std::vector<HandDot> heaps_of(const HandDot& dot, std::uint64_t number, const HandOptions& options);

/// Points along a stroke that deviate from its middle by at most `tolerance` steps.
std::vector<HandNode> flattened(const HandLine& stroke, double tolerance);

}  // namespace sikku
