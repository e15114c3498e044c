#include "art/kolam/dot_grid_enumeration.h"

#include "engine/base/diagnostic.h"
#include "engine/base/json_text.h"
#include "engine/base/threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace sikku {
namespace {

/// Gaps as pairs of bits, the first gap the highest: in the order of the digits. At most 36 orbits of 12 gaps.
using Mask = std::array<std::uint64_t, 14>;
constexpr std::size_t most_gaps = 448;

std::uint64_t digit(const Mask& mask, std::size_t gap) {
    return mask[gap / 32] >> (62 - 2 * (gap % 32)) & 3U;
}
void toggle(Mask& mask, std::size_t gap, std::uint64_t digit) {
    mask[gap / 32] ^= digit << (62 - 2 * (gap % 32));
}

/// Two ends of arcs that meet. An arc a has the ends 2a, at its first side, and 2a + 1.
struct Joint {
    std::uint32_t first;
    std::uint32_t second;
};
Joint numbered(const ArcJoint& joint) {
    return {2 * joint.first.arc + joint.first.end, 2 * joint.second.arc + joint.second.end};
}

/// One orbit of gaps: the joints of its gaps in each state.
struct Choice {
    std::vector<std::uint32_t> gaps;
    std::array<std::vector<Joint>, 3> joints;  // [state]
};

struct Plan {
    const DotGrid& grid;
    GridSymmetry symmetry;
    std::uint64_t state_count;
    std::vector<Choice> choices;
    std::vector<Joint> border;
    std::vector<std::vector<std::uint32_t>> symmetries;  // symmetries of the grid, without the identity
};

Plan make_plan(const DotGrid& grid, const EnumerationOptions& options) {
    Plan plan{grid, options.symmetry, options.joined ? 3U : 2U, {}, {}, {}};
    const std::vector<std::uint32_t> orbits = gap_orbits(grid, options.symmetry);
    const std::size_t choices = orbits.empty() ? 0 : 1U + *std::max_element(orbits.begin(), orbits.end());
    const int most = options.joined ? most_choices_of_three : most_choices;
    if (choices > static_cast<std::size_t>(most)) {
        throw std::runtime_error(fmt::format(
            "cannot enumerate the kolams of {}: its {} {} gaps make {}^{} of them, and more than {}^{} take hours",
            grid.name(), choices, options.symmetry == GridSymmetry::none ? "free" : "classes of", plan.state_count,
            choices, plan.state_count, most));
    }
    static_assert(most_gaps >= std::size_t{12} * most_choices);
    plan.choices.resize(choices);
    for (std::uint32_t i = 0; i < orbits.size(); ++i) {
        Choice& choice = plan.choices[orbits[i]];
        choice.gaps.push_back(i);
        for (std::size_t state = 0; state < plan.state_count; ++state) {
            for (const ArcJoint& joint : joints(grid, grid.gaps()[i], static_cast<GapState>(state))) {
                choice.joints[state].push_back(numbered(joint));
            }
        }
    }
    for (std::uint32_t dot = 0; dot < grid.dots().size(); ++dot) {
        for (std::uint32_t side = 0; side < grid.sides(); ++side) {
            if (grid.gap(dot, side) < 0) plan.border.push_back(numbered(turning_back(grid, dot, side)));
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
        : plan_(plan), keep_(keep), monitor_(monitor), partner_(2 * plan.grid.sides() * plan.grid.dots().size()) {
        for (std::uint32_t i = 0; i < partner_.size(); ++i) partner_[i] = i ^ 1U;
        for (const Joint& joint : plan.border) join(joint);
    }

    /// @param prefix  the first `depth` choices, the first the highest digit
    void run(std::uint64_t prefix, std::size_t depth) {
        monitor_.check();
        std::uint64_t weight = 1;
        for (std::size_t i = 1; i < depth; ++i) weight *= plan_.state_count;
        for (std::size_t i = 0; i < depth; ++i, weight /= plan_.state_count) {
            if (closed_ > 0) return;  // and gaps are left
            decide(i, prefix / weight % plan_.state_count);
        }
        descend(depth);
    }

    std::uint64_t single_line = 0;
    std::uint64_t distinct = 0;
    std::vector<GapStates> kolams;

private:
    void descend(std::size_t choice) {
        if (choice == plan_.choices.size()) {
            if (closed_ == 1) found();
            return;
        }
        if (closed_ > 0) return;
        if ((++visited_ & 0xFFFFFU) == 0) monitor_.check();
        for (std::uint64_t state = 0; state < plan_.state_count; ++state) {
            decide(choice, state);
            descend(choice + 1);
            undo(choice, state);
        }
    }

    void decide(std::size_t choice, std::uint64_t state) {
        for (const Joint& joint : plan_.choices[choice].joints[state]) join(joint);
        if (state != 0) toggle_all(choice, state);
    }
    void undo(std::size_t choice, std::uint64_t state) {
        const auto& joints = plan_.choices[choice].joints[state];
        for (std::size_t i = joints.size(); i-- > 0;) part(joints[i]);
        if (state != 0) toggle_all(choice, state);
    }
    void toggle_all(std::size_t choice, std::uint64_t state) {
        for (const std::uint32_t gap : plan_.choices[choice].gaps) toggle(mask_, gap, state);
    }

    /// partner_ of a loose end is the other loose end of its stretch of line; that of a joined end keeps its value,
    /// so that a joint can be undone.
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
                toggle(image, images[i], digit(mask_, i));
            }
            // Only members of a class with the requested symmetry count.
            if (image < mask_ && has_symmetry_asked(image)) return;
        }
        ++distinct;
        if (kolams.size() < keep_) kolams.push_back(states(mask_));
    }
    bool has_symmetry_asked(const Mask& mask) const {
        for (const Choice& choice : plan_.choices) {
            for (const std::uint32_t gap : choice.gaps) {
                if (digit(mask, gap) != digit(mask, choice.gaps[0])) return false;
            }
        }
        return true;
    }
    GapStates states(const Mask& mask) const {
        GapStates result(plan_.grid.gaps().size());
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = static_cast<GapState>(digit(mask, i));
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
    const Plan plan = make_plan(grid, options);
    const std::size_t depth = std::min<std::size_t>(plan.choices.size(), options.joined ? 6 : 10);
    std::size_t prefixes = 1;
    for (std::size_t i = 0; i < depth; ++i) prefixes *= plan.state_count;
    std::vector<Search> searches(prefixes, Search(plan, options.keep, options.monitor));
    on_threads(options.threads, [&] {
        for_each_index(searches.size(), [&](std::size_t prefix) { searches[prefix].run(prefix, depth); });
    });
    Enumeration all;
    all.choices = static_cast<int>(plan.choices.size());
    all.states = 1;
    for (std::size_t i = 0; i < plan.choices.size(); ++i) all.states *= plan.state_count;
    for (Search& search : searches) {
        all.single_line += search.single_line;
        all.distinct += search.distinct;
        for (GapStates& kolam : search.kolams) {
            if (all.kolams.size() < options.keep) all.kolams.push_back(std::move(kolam));
        }
    }
    return all;
}

std::string enumeration_json(const DotGrid& grid, GridSymmetry symmetry, const Enumeration& found) {
    const auto states = [&](const GapStates& kolam) { return gap_states_text(grid, kolam); };
    return JsonText::object("grid", grid.text(), "symmetry", grid_symmetry_name(symmetry), "dots", grid.dots().size(),
                            "gaps", grid.gaps().size(), "choices", found.choices, "states", found.states,
                            "single_line", found.single_line, "distinct", found.distinct, "kolams",
                            JsonText::list(found.kolams, states))
        .line();
}

std::string enumeration_text(const DotGrid& grid, GridSymmetry symmetry, const Enumeration& found) {
    std::string text = grid.name();
    if (symmetry != GridSymmetry::none) text += fmt::format(" with the symmetry {}", grid_symmetry_name(symmetry));
    text += fmt::format(": {} states, {} with a single line, {} of them distinct\n", found.states, found.single_line,
                        found.distinct);
    for (const GapStates& kolam : found.kolams) text += gap_states_text(grid, kolam) + '\n';
    return text;
}

}  // namespace sikku
