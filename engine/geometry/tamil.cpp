#include "engine/geometry/tamil.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace sikku {
namespace {

// A letter is a path: M begins a stroke, L draws a line, and the others draw curves: to a point where the curve is
// horizontal (H) or vertical (V), to one where its direction follows from its neighbours (S), or to a corner (C). Z
// closes the stroke. Between H and V a curve is a quarter of an ellipse. Letters are 16 units high.

/// Reads the numbers of a path and calls `visit(command, point)` for each point.
template <class Visit>
void for_each_point(std::string_view path, const Visit& visit) {
    std::size_t at = 0;
    const auto number = [&] {
        const bool is_negative = path[at] == '-';
        if (is_negative) ++at;
        double value = 0, place = 0;
        for (; at < path.size() && ((path[at] >= '0' && path[at] <= '9') || path[at] == '.'); ++at) {
            if (path[at] == '.') {
                place = 1;
                continue;
            }
            value = 10 * value + (path[at] - '0');
            place *= 10;
        }
        value /= std::max(place, 1.0);
        return is_negative ? -value : value;
    };
    while (at < path.size()) {
        const char command = path[at++];
        glm::dvec2 point(0.0);
        if (command != 'Z') {
            point.x = number();
            ++at;  // the blank
            point.y = number();
        }
        visit(command, point);
    }
}

std::string moved(std::string_view path, double dx, double dy = 0) {
    std::string result;
    for_each_point(path, [&](char command, glm::dvec2 point) {
        result += command;
        if (command != 'Z') result += fmt::format("{:.2f} {:.2f}", point.x + dx, point.y + dy);
    });
    return result;
}

struct Node {
    char command = 'M';
    glm::dvec2 at{0.0};
};

/// The direction of a stroke at a node, or 0 0.
glm::dvec2 direction(std::span<const Node> nodes, std::size_t i, bool is_closed) {
    const std::size_t last = nodes.size() - 1;
    if (is_closed && (i == 0 || i == last)) return {std::copysign(1.0, nodes[1].at.x - nodes[0].at.x), 0.0};
    const char command = nodes[i].command;
    const glm::dvec2 before = i > 0 ? nodes[i].at - nodes[i - 1].at : glm::dvec2(0.0);
    const glm::dvec2 after = i < last ? nodes[i + 1].at - nodes[i].at : glm::dvec2(0.0);
    const bool is_line_next = i < last && nodes[i + 1].command == 'L';
    if (command == 'C' || command == 'M') return glm::dvec2(0.0);
    if (command == 'L') return is_line_next ? glm::dvec2(0.0) : glm::normalize(before);
    if (is_line_next) return glm::normalize(after);
    if (command == 'H') return {std::copysign(1.0, before.x), 0.0};
    if (command == 'V') return {0.0, std::copysign(1.0, before.y)};
    if (i == last) return glm::dvec2(0.0);
    // Tangent of the circle through the three points.
    return glm::normalize(before * glm::length(after) / glm::length(before) +
                          after * glm::length(before) / glm::length(after));
}

LetterStroke::Piece piece_between(glm::dvec2 from, glm::dvec2 to, glm::dvec2 out, glm::dvec2 in) {
    constexpr double quarter = 0.5523;  // of an ellipse
    const glm::dvec2 way = to - from;
    const double length = glm::length(way);
    const glm::dvec2 along = way / length;
    const auto none = [](glm::dvec2 one) { return one == glm::dvec2(0.0); };
    if (none(out) && none(in)) return {false, {}, {}, to};
    // At an end of the stroke the curve is an arc.
    const auto mirrored = [&](glm::dvec2 one) { return 2.0 * glm::dot(one, along) * along - one; };
    if (none(out)) out = mirrored(in);
    if (none(in)) in = mirrored(out);
    const auto is_axis = [](glm::dvec2 one) { return one.x == 0 || one.y == 0; };
    glm::dvec2 handles;
    if (is_axis(out) && is_axis(in) && glm::dot(out, in) == 0) {
        handles = quarter * glm::dvec2(std::fabs(glm::dot(way, out)), std::fabs(glm::dot(way, in)));
    } else {
        const auto arc = [&](glm::dvec2 one) {
            const double cosine = std::clamp(glm::dot(one, along), -1.0, 1.0);
            return std::min(length / (1.5 * (1 + cosine)), length);  // the square of the cosine of half the angle
        };
        handles = {arc(out), arc(in)};
    }
    return {true, from + handles.x * out, to - handles.y * in, to};
}

std::vector<LetterStroke> strokes_of(std::string_view path) {
    std::vector<LetterStroke> strokes;
    std::vector<Node> nodes;
    bool is_closed = false;
    const auto finish = [&] {
        if (nodes.empty()) return;
        LetterStroke& stroke = strokes.emplace_back();
        stroke.start = nodes.front().at;
        stroke.is_closed = is_closed;
        for (std::size_t i = 1; i < nodes.size(); ++i) {
            if (nodes[i].command == 'L') {
                stroke.pieces.push_back({false, {}, {}, nodes[i].at});
            } else {
                stroke.pieces.push_back(piece_between(nodes[i - 1].at, nodes[i].at,
                                                      direction(nodes, i - 1, is_closed),
                                                      direction(nodes, i, is_closed)));
            }
        }
        nodes.clear();
        is_closed = false;
    };
    for_each_point(path, [&](char command, glm::dvec2 point) {
        if (command == 'M') finish();
        if (command == 'Z') {
            is_closed = true;
            command = 'H';
            point = nodes.front().at;
        }
        nodes.push_back({command, point});
    });
    finish();
    return strokes;
}

std::string ring(double x, double y, double radius) {
    return fmt::format("M{:.2f} {:.2f}V{:.2f} {:.2f}H{:.2f} {:.2f}V{:.2f} {:.2f}Z", x, y + radius, x - radius, y, x,
                       y - radius, x + radius, y);
}

// Parts of several letters.
const std::string head = "M.8 5.2H4.8 8V8.8 4H4.6 0V0 6.2";  // the loop at the foot on the left
const std::string bar = "M4.4 8.6L4.4 16L18.5 16";           // of ka
const std::string ka = bar + "M11.5 16L11.5 6H5.6 0V.8 4.4H5 8.6";
const std::string two_stems = head + "H9 16S14.6 13M14.8 0L14.8 16L29 16M22.2 16L22.2 0";
const std::string ai_top = "M6 15.8V9 10.8H5 6.4V.6 11H7.6 16V14 10.6M14 6L14 10.6H19.4 16V25 9.6H16 3L9.6 3V.6 -2.8";
const std::string u_vowel = "M6.2 15.7V8 12H4 8.2V0 12H6 16V15 10H6 3.2V1 1.6H3 0";
const std::string a_vowel = "M14.6 15.7V16.6 12H12.6 8.2V8.6 12H14.4 16V22.6 7.6H9 -2.8V1 .9H5 4.4L27 4.4M27 16";
const std::string o_vowel =
    "M1 7.2H5.2 10V9.2 6H5 2V.2 7.2H13 16V25 7.8H20.9 2.2V17.2 5.4S18 9.4"
    "M18 9.4V12.8 3.4H18 -1.8L24 -1.8";
const std::string one_loop = head + "H10 16V21.6 4.8H17.2 0V13 4.8";
const std::string two_loops = one_loop + "H24 16V34.2 4.8H29.8 0V25.6 4.8";
const std::string arches = "M2 0L2 11H6 16V10 10.8L10 0M10 10.8H15.2 16V21 8";
const std::string na_stems = "M2 0L2 16L16.4 16M9.4 16L9.4 0";
const std::string nga = "M0 0L0 16L14 16M7.6 16L7.6 4.4M7.6 6.6H11.8 8.8V16.2 4.6S14 0M7 0L24 0";
const std::string ya = "M0 16L0 4.4H3.8 0S8 3.6M8 16L8 0L22.5 0";
const std::string va = head + "H8.8 16V16 9.4C13.4 0L24.5 0";
const std::string ssa = "H8.8 16V16 9.4C13.4 0L34 0L34 8.4H27 6V21.4 11H24.8 16S28.2 11L23.6 -7.8";
const std::string tail = "H10 -3.6L6.8 -3.6V1 -8.2";  // to the left, below
const std::string from_left = "V1 4S5 15.8";          // up to the top on the left
const std::string from_ring = "M1.5 9.6H5.2 8.6V9 12.2H5.8 16V1 5";

/// A line that continues below a letter to the left edge and back to the stem of the sign u, or of uu.
std::string swept(const std::string& letter, double left, double stem, bool is_long) {
    const std::string flat = stem > 36 ? fmt::format("H{:.2f} -8.2L{:.2f} -8.2", stem - 19, left + 8)
                                       : fmt::format("H{:.2f} -8.2", left + 9);
    std::string path =
        fmt::format("{}{}V{:.2f} -6H{:.2f} -3.8L{:.2f} -3.8L{:.2f} 16", letter, flat, left, left + 2.4, stem, stem);
    if (is_long) path += fmt::format("L{:.2f} 16M{:.2f} 16L{:.2f} -3.8", stem + 14, stem + 7.6, stem + 7.6);
    return path;
}

/// A letter with a stem on the right that the signs u and uu lengthen.
std::string lengthened(const std::string& letter, double stem, bool is_long) {
    if (!is_long) return fmt::format("{}M{:.2f} 16L{:.2f} -8.2", letter, stem, stem);
    return fmt::format(
        "{}M{:.2f} 16L{:.2f} -4M{:.2f} .8H{:.2f} 2.6V{:.2f} -1.8H{:.2f} -8.2L8 -8.2V.4 -5.4H3.8 -2.8"
        "S8.8 -3.6",
        letter, stem, stem, stem, stem + 3.6, stem + 7.6, stem - 5.5);
}

using Letters = std::map<std::u32string, std::string>;

Letters vowels_and_consonants() {
    return {
        {U"அ", a_vowel + "L27 -4"},
        {U"ஆ", a_vowel + "L27 -3M27 1.2H30.4 2.6V34.8 -1.8H25.4 -8V18 -5H20.6 -2.4S23.6 -3"},
        {U"இ",
         "M13.4 15.7V15.4 12H11.4 8.2V7.4 12H13.2 16V20.8 8.4S18 .4S12 -5.8H6 -8.2V.8 -4H12.4 3.6V24 -4"
         "H18.8 -8.2S12.4 -5.8S5 1.2V1.2 11H14.6 23.6V28 8L28 0"},
        {U"ஈ", "M0 0L0 16L17.5 16M10.5 16L10.5 0" + ring(5.2, 8, 0.9) + ring(14.6, 8, 0.9)},
        {U"உ", u_vowel + "L26 0"},
        {U"ஊ", u_vowel + "L40 0" +
                   moved("M.6 4.1H3.8 6.3V6.9 3.2H3.6 0V0 4.9H6.8 12.6S11 10.6M11.4 0L11.4 12.6L22 12.6"
                         "M17 12.6L17 0",
                         18, 3.4)},
        {U"எ", head + "H9.6 16L21 16M15.4 16L15.4 0"},
        {U"ஏ", head + "H9.6 16L21 16M15.4 16L15.4 0L9.8 -5.4"},
        {U"ஐ", ai_top + "H7.4 -8.2V14 -3.4L14 -.6M14 -3.4H19.4 -8.2V25 -3.4S24 1"},
        {U"ஒ", o_vowel + "M20 -1.8S16.4 -6.4H10.6 -8.2V5.2 -4S7 .4"},
        {U"ஓ", o_vowel + "M20 -1.8S16.4 -6.4H9.2 -8.2V4.2 -4.6H8.2 -1V12.2 -4.4S10 -8"},
        {U"ஔ", o_vowel + "M20 -1.8S16.4 -6.4H10.6 -8.2V5.2 -4S7 .4" + moved(two_stems, 28)},
        {U"ஃ", ring(4.4, 4.4, 4.4) + ring(17.2, 4.4, 4.4) + ring(10.8, 18, 4.4)},
        {U"க", ka + "L15 8.6V20.2 4.4H15.6 0S13.2 .3"},
        {U"ங", nga + "L24 16"},
        {U"ச", ka + "L18.5 8.6"},
        {U"ஞ", "M4.8 15.8V1 4H16 -8.2V31 2H27 8.6S22.4 6.4" + moved(head + "H9.6 16L21.4 16M15.4 16L15.4 0", 7)},
        {U"ட", "M0 16L0 0L16.5 0"},
        {U"ண", two_loops + "H37 16L46 16M39.6 16L39.6 0"},
        {U"த", ka + "L11.6 8.6V20.6 2.4" + tail},
        {U"ந", na_stems + "M9.4 6.2H14 8.6V19 2.4" + tail},
        {U"ப", "M0 16L0 0L16.5 0L16.5 16"},
        {U"ம", "M0 16L0 0L13.2 0V19.6 8H15 16V10.4 9L10.4 0"},
        {U"ய", ya + "L22.5 16"},
        {U"ர", "M0 0L0 16L15 16M9.4 16L9.4 0L3.8 -5.4"},
        {U"ல", head + "H8.6 16V14.4 9.4L14.4 6H19.4 0V25.2 7S21 16.6"},
        {U"வ", va + "L24.5 16"},
        {U"ழ",
         "M1.4 16L1.4 0L14 0V20.4 8H15.8 16V11.2 9L11.2 0H14.8 -3.6L20 -3.6"
         "M14.6 -3.6S11.6 -7H6 -8.2V1 -5.2H3.6 -2.6S6.4 -3.2"},
        {U"ள", two_stems},
        {U"ற", arches + "H10 -3.6L7 -3.6V1.2 -8.2"},
        {U"ன", one_loop + "H24 16L33.4 16M27 16L27 0"},
        {U"ஜ", ai_top + "H6.4 -8.2H20.6 -.8V24.8 -4.4H20.8 -8.2V16.8 -4.8S18.4 -1.4"},
        {U"ஷ", head + ssa},
        {U"ஸ", head + "H8.8 16V14.8 10.8L14.8 0M14.8 10.8H18.8 16V22.9 9.4L22.9 6H27.8 0V33.4 7S29.4 16.6"},
        {U"ஹ", head + "H8.8 16V16 9.4C13.4 0L25 0L25 11H28.8 16V32.4 10.8L32.4 0M32.4 10.8H37.4 16V43 8H32 -3.6"
                      "L7 -3.6V1.2 -8.2"},
        {U"ஶ", "M0 16L0 5.6H5.2 0V10.4 5.6L10.4 16L27.6 16L27.6 5.6H22.4 0V17.2 5.6L17.2 16"},
        {U"க்ஷ", ka + "L17 8.6V26.2 4H22 0V17.8 5.2H25.6 13.6V33 8C30.4 0L51 0L51 8.4H44 6V38.4 11H41.8 16S45.2 11"
                     "L40.6 -7.8"},
        {U"ஸ்ரீ",
         "M0 16L0 0L13.5 0L13.5 11H17.4 16V21.4 10.8M21.4 0L21.4 16L34 16M29 0L29 18.6H33.8 23.6V38.6 20.4"
         "H35.4 17.2V32.4 20S33.4 23.4M29 6.4H33.8 8.6V38.8 2.6H16 -8.2V2 -5.4H5.4 -2.8S10.4 -3.4"},
    };
}

/// Signs that stand beside their consonant.
const Letters& signs() {
    static const Letters made = {
        {U"ா", "M0 0L0 16L14 16M7.6 16L7.6 0"},
        {U"ி", "M0 16H7 23.6V13.4 15L13.4 0"},
        {U"ீ", "M0 16H5.2 23.6V9.8 20.2H6.6 17V3.8 20S5.2 23.2"},
        {U"ு", "M0 16L10.4 16V16.8 11.6H12.6 7.6V8.4 11.6S10.4 16"},
        {U"ூ", "M0 16L10.4 16V16.4 12H12.6 8V8.4 13H17.6 21.6V27 11H16.4 .6S8.4 3.6"},
        {U"ெ", "M1 5.4H5 8.2V9 4.1H4.8 0V.2 9H9 23.6V17.6 12L17.6 0"},
        {U"ே", "M1 5.4H5 8.2V9 4.1H4.8 0V.2 9H10.6 23.6V18.4 19.8H14.6 16.2V11 19.4S13 23.2"},
        {U"ை", head + "H10 16V19.4 4.8H15.4 0V11.4 4.8H21.6 16V29.2 7S26 0"},
        {U"ௗ", two_stems},
        {U"்", ring(0, 21, 0.9)},
    };
    return made;
}

/// Consonants with u and uu.
void add_u(Letters& letters) {
    const auto both = [&](const char32_t* consonant, const auto& path) {
        letters[std::u32string(consonant) + U"ு"] = path(false);
        letters[std::u32string(consonant) + U"ூ"] = path(true);
    };
    const auto sweep = [&](const char32_t* consonant, const std::string& letter, double left, double stem) {
        both(consonant, [&](bool is_long) { return swept(letter, left, stem, is_long); });
    };
    sweep(U"ஞ", head + "H9.6 16L21 16M15.4 16L15.4 0M15.4 6.4H19.4 8.8V24.4 2.4", 0.2, 30.6);
    sweep(U"ண", two_loops + "H36 16V43.4 6", 0.2, 49.4);
    sweep(U"த", ka + "L11.4 8.6V20.6 2", 0.8, 26.6);
    sweep(U"ந", na_stems + "M9.4 6.4H13.4 8.8V19 2.4", 0.8, 25.2);
    sweep(U"ல", letters[U"ல"] + "M22 .6S18.4 -5.4", 0.2, 31.4);
    sweep(U"ற", arches, 0.8, 27);
    sweep(U"ன", one_loop + "H23.4 16V31 6", 0.2, 37.2);
    const auto lengthen = [&](const char32_t* consonant, const std::string& letter, double stem) {
        both(consonant, [&](bool is_long) { return lengthened(letter, stem, is_long); });
    };
    lengthen(U"ங", nga, 24);
    lengthen(U"ப", "M0 16L0 0L16.5 0", 16.5);
    lengthen(U"ய", ya, 22.5);
    lengthen(U"வ", va, 24.5);
    const auto with_sign = [&](const char32_t* consonant, double foot, double above) {
        for (const char32_t* sign : {U"ு", U"ூ"}) {
            letters[std::u32string(consonant) + sign] = letters[consonant] + moved(signs().at(sign), foot, above);
        }
    };
    with_sign(U"ஜ", 19.4, 0);
    with_sign(U"ஹ", 37.4, 0);
    with_sign(U"ஸ", 29.6, 0.6);
    with_sign(U"ஷ", 24.8, 0);
    with_sign(U"ஶ", 27.6, 0);
    with_sign(U"க்ஷ", 41.8, 0);

    letters[U"கு"] = moved(ka, 6.4) + "L17.6 8.6V28 1.6H14.6 -8.2" + from_left;
    letters[U"கூ"] = ka + "L17 8.6V26 4H21.6 0V17.6 5.2H25.4 13V32.8 7.8C30.2 0L38 0";
    letters[U"சு"] = ka + "L23.4 8.6M18.4 8.6L18.4 0";
    letters[U"சூ"] = moved(ka, 6.4) + "L29.4 8.6M25.4 8.6L25.4 0M25.4 3.2H28.6 5V32.2 .4H17 -8.2" + from_left;
    letters[U"டு"] = "M9 16L9 0M9 6.4H13 8.8V19.2 0H10.6 -8.2V.6 7H14 23.6V25 14L25 0";
    letters[U"டூ"] =
        "M9 16L9 0M9 6.4H13 8.8V19 0H10.6 -8.2V.6 7H14.8 23.6V24 16H19.6 11.6V15.6 15.2H19.4 19S22.6 17.8";
    letters[U"மு"] = "M5 15.8V1 3.6H10.4 -8.2V19.6 .6L19.6 9H24.2 16V28.8 8H22.4 0L9.4 0L9.4 16";
    letters[U"மூ"] = from_ring + "H12.8 -8.2V22.4 .6L22.4 9H27 16V31.6 8H25.2 0L12.2 0L12.2 16";
    letters[U"ரு"] = "M9.4 0L9.4 16L25 16M18.6 16L18.6 0M18.6 6.4H23 8.8V28.4 2.4H14.6 -8.2" + from_left;
    letters[U"ரூ"] = from_ring + "H17 -8.2V31.2 2.4H25.8 8.8S21.4 6.4M12.2 0L12.2 16L27.8 16M21.4 16L21.4 0";
    letters[U"ழு"] =
        "M9.4 16L9.4 0L22.4 0V28.8 8H24.2 16V19.6 9L19.6 -5M19.6 -3.2H23 -1.6V26.4 -4.4H15 -8.2" + from_left;
    letters[U"ழூ"] = from_ring +
                     "H18 -8.2V29.2 -4.4H25.8 -1.6S22.4 -3.2M12.2 16L12.2 0L25.2 0V31.6 8H27 16V22.4 9"
                     "L22.4 -5";
    letters[U"ளு"] = moved(two_stems, 7.6) + "M29.8 6.4H34 8.8V39.6 2.4H20.4 -8.2" + from_left;
    letters[U"ளூ"] = from_ring + "H22 -8.2V42.2 2.4H36.6 8.8S32.4 6.4" + moved(two_stems, 10.2);
}

/// Consonants with i and ii, which begin at a bar or an arch at the top, at a stem on the right, or at the end of the
/// letter.
void add_i(Letters& letters) {
    const auto add = [&](const char32_t* consonant, const std::string& i, const std::string& ii) {
        letters[std::u32string(consonant) + U"ி"] = letters[consonant] + i;
        letters[std::u32string(consonant) + U"ீ"] = letters[consonant] + ii;
    };
    struct Top {
        const char32_t* consonant;
        double foot, stem;
    };
    constexpr std::array<Top, 17> tops = {{{U"க", 11.5, 24.8},
                                           {U"ச", 10.5, 22.6},
                                           {U"ஞ", 23, 35.4},
                                           {U"ண", 37, 50},
                                           {U"த", 11.5, 25.2},
                                           {U"ந", 9.4, 23.4},
                                           {U"ர", 5.6, 19},
                                           {U"ள", 20, 33},
                                           {U"ன", 24.4, 37.4},
                                           {U"ம", 14, 24.4},
                                           {U"ழ", 15, 25.2},
                                           {U"ற", 14.6, 25.8},
                                           {U"ஜ", 18.6, 29.8},
                                           {U"ஹ", 36.8, 47.8},
                                           {U"ஷ", 24.4, 38.6},
                                           {U"க்ஷ", 41.4, 55.6},
                                           {U"ஶ", 19, 32.4}}};
    for (const auto& [consonant, foot, stem] : tops) {
        add(consonant,
            fmt::format("M{:.2f} 16H{:.2f} 23.6V{:.2f} 15L{:.2f} 0", foot, foot + 0.52 * (stem - foot), stem, stem),
            moved(signs().at(U"ீ"), foot));
    }
    using Stem = std::pair<const char32_t*, double>;
    for (const auto& [consonant, x] : {Stem(U"ங", 24), Stem(U"ப", 16.5), Stem(U"ய", 22.5), Stem(U"வ", 24.5)}) {
        add(consonant, moved("M0 9.8V-5.4 15.2H1 23.6V6.6 15L6.6 0", x),
            moved("M0 9.8V-5.4 15.8H-.2 23.6V4.6 20.2H1.4 17V-1.4 20S0 23.2", x));
    }
    for (const auto& [consonant, x] : {Stem(U"ல", 21), Stem(U"ஸ", 29.4)}) {
        add(consonant, moved("M0 16.6V-1.6 19.4H3.6 23.6V9 15L9 0", x),
            moved("M0 16.6V-1.6 19.4H3.2 23.6V8 20.4H5.2 17.4V2.6 20S3.8 23", x));
    }
    letters[U"டி"] = "M0 16L0 0L18.4 0M10 -7.8L14.6 10H11.4 13.4V8 9.4S12.8 0";
    letters[U"டீ"] = "M0 16L0 0L18.4 0M10.4 0V7.4 6H13.4 13.4V18 9.6H14.8 6.4V11.8 9.4S13 12.6";
}

struct Shape {
    std::vector<LetterStroke> strokes;
    double low = 0, high = 0;  ///< extent of the ink, across
};

Shape shape_of(std::string_view path) {
    Shape shape{strokes_of(path), 1e9, -1e9};
    for_each_point(path, [&](char command, glm::dvec2 point) {
        if (command == 'Z') return;
        shape.low = std::min(shape.low, point.x);
        shape.high = std::max(shape.high, point.x);
    });
    return shape;
}

using Shapes = std::map<std::u32string, Shape, std::less<>>;

const Shapes& shapes() {
    static const Shapes made = [] {
        Letters letters = vowels_and_consonants();
        letters[U"ஶ்ரீ"] = letters[U"ஸ்ரீ"];
        add_u(letters);
        add_i(letters);
        letters.insert(signs().begin(), signs().end());
        Shapes result;
        for (const auto& [name, path] : letters) result.emplace(name, shape_of(path));
        return result;
    }();
    return made;
}

constexpr char32_t pulli = U'\u0BCD';

bool is_consonant(char32_t code) {
    return code >= U'க' && code <= U'ஹ';
}

/// The parts of a vowel sign to the left and to the right of its consonant; empty for signs above, below and joined.
struct SignParts {
    char32_t sign;
    std::u32string_view left, right;
};
constexpr std::array<SignParts, 8> sign_parts = {{{U'ா', U"", U"ா"},
                                                  {U'ெ', U"ெ", U""},
                                                  {U'ே', U"ே", U""},
                                                  {U'ை', U"ை", U""},
                                                  {U'ொ', U"ெ", U"ா"},
                                                  {U'ோ', U"ே", U"ா"},
                                                  {U'ௌ', U"ெ", U"ௗ"},
                                                  {U'ௗ', U"", U"ௗ"}}};

/// Composed signs and vowels that may be written as two characters.
constexpr std::array<std::pair<std::u32string_view, char32_t>, 4> composed = {{{U"\u0BC6\u0BBE", U'\u0BCA'},
                                                                               {U"\u0BC7\u0BBE", U'\u0BCB'},
                                                                               {U"\u0BC6\u0BD7", U'\u0BCC'},
                                                                               {U"\u0B92\u0BD7", U'\u0B94'}}};

/// The first character of a text, and the number of code points that it takes.
std::pair<char32_t, std::size_t> composed_character(std::u32string_view text) {
    for (const auto& [parts, whole] : composed) {
        if (text.starts_with(parts)) return {whole, parts.size()};
    }
    return {text.empty() ? U'\0' : text.front(), 1};
}

}  // namespace

std::optional<TamilSyllable> tamil_syllable(std::u32string_view text) {
    constexpr double bearing = 2.8;  // space beside the ink of each part
    TamilSyllable syllable;
    const auto place = [&](const Shape& shape, double x) {
        const glm::dvec2 by(x, 0.0);
        for (LetterStroke stroke : shape.strokes) {
            stroke.start += by;
            for (LetterStroke::Piece& piece : stroke.pieces) {
                for (glm::dvec2* point : {&piece.first, &piece.second, &piece.end}) *point += by;
            }
            syllable.strokes.push_back(std::move(stroke));
        }
    };
    const auto add = [&](std::u32string_view name) {
        const auto found = shapes().find(name);
        if (found == shapes().end()) return false;
        const Shape& shape = found->second;
        place(shape, syllable.width + bearing - shape.low);
        syllable.width += shape.high - shape.low + 2 * bearing;
        return true;
    };
    const auto [first, taken] = composed_character(text);
    const auto parts_of = [](char32_t sign) {
        return std::find_if(sign_parts.begin(), sign_parts.end(),
                            [&](const SignParts& one) { return one.sign == sign; });
    };
    syllable.characters = taken;
    if (!is_consonant(first)) {
        const auto parts = parts_of(first);
        if (parts != sign_parts.end()) {
            if (!parts->left.empty()) add(parts->left);
            if (!parts->right.empty()) add(parts->right);
            return syllable;
        }
        if (!add(std::u32string_view(&first, 1))) return std::nullopt;
        return syllable;
    }
    std::u32string base(1, first);
    for (const std::u32string_view ligature : {U"க்ஷ", U"ஸ்ரீ", U"ஶ்ரீ"}) {
        if (!text.starts_with(ligature)) continue;
        base = ligature;
        syllable.characters = ligature.size();
    }
    if (!shapes().contains(base)) return std::nullopt;
    const auto [sign, more] = composed_character(text.substr(syllable.characters));
    const auto parts = parts_of(sign);
    if (parts != sign_parts.end()) {
        if (!parts->left.empty()) add(parts->left);
        add(base);
        if (!parts->right.empty()) add(parts->right);
        syllable.characters += more;
    } else if (sign == pulli) {
        add(base);
        const Shape& letter = shapes().at(base);
        place(shapes().at(U"்"), bearing + (letter.high - letter.low) / 2);
        ++syllable.characters;
    } else if (shapes().contains(base + sign)) {
        add(base + sign);
        ++syllable.characters;
    } else {
        add(base);
    }
    return syllable;
}

}  // namespace sikku
