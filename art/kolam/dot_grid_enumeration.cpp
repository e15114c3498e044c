#include "art/kolam/dot_grid_enumeration.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/base/threads.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace sikku {
namespace {

/// Gaps as bits, the first gap the highest: in the order of the digits. 36 orbits of 8 gaps are the most.
using Mask = std::array<std::uint64_t, 5>;
constexpr std::size_t most_gaps = 320;

bool holds(const Mask& mask, std::size_t gap) {
    return (mask[gap / 64] >> (63 - gap % 64) & 1U) != 0;
}
void flip(Mask& mask, std::size_t gap) {
    mask[gap / 64] ^= std::uint64_t{1} << (63 - gap % 64);
}

/// Two ends of arcs that meet. An arc a has the ends 2a, at its first side, and 2a + 1.
struct Joint {
    std::uint32_t first;
    std::uint32_t second;
};
constexpr std::uint32_t end_at(std::uint32_t dot, std::uint32_t arc, std::uint32_t end) {
    return 2 * (4 * dot + arc % 4) + end;
}
Joint turning_back(std::uint32_t dot, std::uint32_t side) {
    return {end_at(dot, side, 0), end_at(dot, side + 3, 1)};
}

/// One orbit of gaps: the joints of its gaps as crossings, and as none.
struct Choice {
    std::vector<std::uint32_t> gaps;
    std::array<std::vector<Joint>, 2> joints;  // [is crossing]
};

struct Plan {
    const DotGrid& grid;
    GridSymmetry symmetry;
    std::vector<Choice> choices;
    std::vector<Joint> border;
    std::vector<std::vector<std::uint32_t>> symmetries;  // of the grid, without the identity
};

Plan make_plan(const DotGrid& grid, GridSymmetry symmetry) {
    Plan plan{grid, symmetry, {}, {}, {}};
    const std::vector<std::uint32_t> orbits = gap_orbits(grid, symmetry);
    const std::size_t choices = orbits.empty() ? 0 : 1U + *std::max_element(orbits.begin(), orbits.end());
    if (choices > most_choices) {
        throw std::runtime_error(
            fmt::format("the kolams of {} are not enumerated: its {} {} gaps make 2^{} of them, and beyond 2^{} it "
                        "takes hours",
                        printable(grid.text(), 80), choices, symmetry == GridSymmetry::none ? "free" : "classes of",
                        choices, most_choices));
    }
    static_assert(most_gaps >= std::size_t{8} * most_choices);
    plan.choices.resize(choices);
    for (std::uint32_t i = 0; i < orbits.size(); ++i) {
        const auto& [from, to, side] = grid.gaps()[i];
        Choice& choice = plan.choices[orbits[i]];
        choice.gaps.push_back(i);
        choice.joints[0].push_back(turning_back(from, side));
        choice.joints[0].push_back(turning_back(to, side + 2));
        choice.joints[1].push_back({end_at(from, side, 0), end_at(to, side + 2, 0)});
        choice.joints[1].push_back({end_at(from, side + 3, 1), end_at(to, side + 1, 1)});
    }
    for (std::uint32_t dot = 0; dot < grid.dots().size(); ++dot) {
        for (std::uint32_t side = 0; side < 4; ++side) {
            if (grid.gap(dot, side) < 0) plan.border.push_back(turning_back(dot, side));
        }
    }
    plan.symmetries = grid_symmetries(grid);
    plan.symmetries.erase(plan.symmetries.begin());
    return plan;
}

/// One search below the first few choices.
class Search {
public:
    Search(const Plan& plan, std::size_t keep, const Monitor& monitor)
        : plan_(plan), keep_(keep), monitor_(monitor), partner_(8 * plan.grid.dots().size()) {
        for (std::uint32_t i = 0; i < partner_.size(); ++i) partner_[i] = i ^ 1U;
        for (const Joint& joint : plan.border) join(joint);
    }

    /// @param prefix  the first `depth` choices, the first the highest bit
    void run(std::uint64_t prefix, std::size_t depth) {
        monitor_.check();
        for (std::size_t i = 0; i < depth; ++i) {
            const bool crossing = (prefix >> (depth - 1 - i) & 1U) != 0;
            if (closed_ > 0) return;  // and gaps are left
            decide(i, crossing);
        }
        descend(depth);
    }

    std::uint64_t single_line = 0;
    std::uint64_t distinct = 0;
    std::vector<Crossings> kolams;

private:
    void descend(std::size_t choice) {
        if (choice == plan_.choices.size()) {
            if (closed_ == 1) found();
            return;
        }
        if (closed_ > 0) return;
        if ((++visited_ & 0xFFFFFU) == 0) monitor_.check();
        for (const bool crossing : {false, true}) {
            decide(choice, crossing);
            descend(choice + 1);
            undo(choice, crossing);
        }
    }

    void decide(std::size_t choice, bool crossing) {
        for (const Joint& joint : plan_.choices[choice].joints[crossing]) join(joint);
        if (crossing) toggle(choice);
    }
    void undo(std::size_t choice, bool crossing) {
        const auto& joints = plan_.choices[choice].joints[crossing];
        for (std::size_t i = joints.size(); i-- > 0;) part(joints[i]);
        if (crossing) toggle(choice);
    }
    void toggle(std::size_t choice) {
        for (const std::uint32_t gap : plan_.choices[choice].gaps) flip(mask_, gap);
    }

    /// partner_ of a loose end is the other loose end of its stretch of line; of an end that was joined it stays what
    /// it was, so that a joint can be undone.
    void join(const Joint& joint) {
        const std::uint32_t a = partner_[joint.first];
        const std::uint32_t b = partner_[joint.second];
        if (a == joint.second) {
            ++closed_;
        } else {
            partner_[a] = b;
            partner_[b] = a;
        }
    }
    void part(const Joint& joint) {
        const std::uint32_t a = partner_[joint.first];
        const std::uint32_t b = partner_[joint.second];
        if (a == joint.second) {
            --closed_;
        } else {
            partner_[a] = joint.first;
            partner_[b] = joint.second;
        }
    }

    void found() {
        ++single_line;
        for (const auto& images : plan_.symmetries) {
            Mask image{};
            for (std::size_t i = 0; i < images.size(); ++i) {
                if (holds(mask_, i)) flip(image, images[i]);
            }
            // Of a class only those count that have the symmetry asked for.
            if (image < mask_ && has_symmetry_asked(image)) return;
        }
        ++distinct;
        if (kolams.size() < keep_) kolams.push_back(crossings(mask_));
    }
    bool has_symmetry_asked(const Mask& mask) const {
        for (const Choice& choice : plan_.choices) {
            for (const std::uint32_t gap : choice.gaps) {
                if (holds(mask, gap) != holds(mask, choice.gaps[0])) return false;
            }
        }
        return true;
    }
    Crossings crossings(const Mask& mask) const {
        Crossings result(plan_.grid.gaps().size());
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = holds(mask, i);
        return result;
    }

    const Plan& plan_;
    std::size_t keep_;
    const Monitor& monitor_;
    std::vector<std::uint32_t> partner_;
    std::uint32_t closed_ = 0;
    std::uint64_t visited_ = 0;
    Mask mask_{};
};

}  // namespace

Enumeration enumerate_single_lines(const DotGrid& grid, const EnumerationOptions& options) {
    const Plan plan = make_plan(grid, options.symmetry);
    const std::size_t depth = std::min<std::size_t>(plan.choices.size(), 10);
    std::vector<Search> searches(std::size_t{1} << depth, Search(plan, options.keep, options.monitor));
    on_threads(options.threads, [&] {
        oneapi::tbb::parallel_for(std::size_t{0}, searches.size(),
                                  [&](std::size_t prefix) { searches[prefix].run(prefix, depth); });
    });
    Enumeration all;
    all.choices = static_cast<int>(plan.choices.size());
    all.states = std::uint64_t{1} << plan.choices.size();
    for (Search& search : searches) {
        all.single_line += search.single_line;
        all.distinct += search.distinct;
        for (Crossings& kolam : search.kolams) {
            if (all.kolams.size() < options.keep) all.kolams.push_back(std::move(kolam));
        }
    }
    return all;
}

std::string enumeration_json(const DotGrid& grid, GridSymmetry symmetry, const Enumeration& found) {
    std::string kolams;
    for (const Crossings& kolam : found.kolams) {
        kolams += (kolams.empty() ? "" : ", ") + json_string(crossings_text(grid, kolam));
    }
    return fmt::format(
        "{{\"grid\": {}, \"symmetry\": {}, \"dots\": {}, \"gaps\": {}, \"choices\": {}, \"states\": {}, "
        "\"single_line\": {}, \"distinct\": {}, \"kolams\": [{}]}}\n",
        json_string(grid.text()), json_string(grid_symmetry_name(symmetry)), grid.dots().size(), grid.gaps().size(),
        found.choices, found.states, found.single_line, found.distinct, kolams);
}

std::string enumeration_text(const DotGrid& grid, GridSymmetry symmetry, const Enumeration& found) {
    std::string text = printable(grid.text(), 80);
    if (symmetry != GridSymmetry::none) text += fmt::format(" with the symmetry {}", grid_symmetry_name(symmetry));
    text += fmt::format(": {} states, {} of a single line, {} of them distinct\n", found.states, found.single_line,
                        found.distinct);
    for (const Crossings& kolam : found.kolams) text += crossings_text(grid, kolam) + '\n';
    return text;
}

}  // namespace sikku
