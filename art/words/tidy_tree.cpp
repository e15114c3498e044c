#include "art/words/tidy_tree.h"

#include <utility>

namespace sikku {
namespace {

constexpr std::size_t nothing = static_cast<std::size_t>(-1);

/// Walker's algorithm, with the names of the source: `prelim`, `mod`, `thread`, `ancestor`, `shift`, `change`.
class TidyPlaces {
public:
    explicit TidyPlaces(const std::vector<TidyNode>& nodes)
        : nodes_(nodes), work_(nodes.size()), places_(nodes.size()) {
        for (std::size_t v = 0; v < nodes.size(); ++v) {
            work_[v].ancestor = v;
            for (std::size_t k = 0; k < nodes[v].children; ++k) {
                Work& child = work_[nodes[v].first_child + k];
                child.parent = v;
                child.number = k;
            }
        }
        if (nodes.empty()) return;
        first_walk(0);
        second_walk(0, -work_[0].prelim);
    }
    std::vector<double> places() { return std::move(places_); }

private:
    struct Work {
        double prelim = 0, mod = 0, shift = 0, change = 0;
        std::size_t thread = nothing, ancestor = nothing, parent = nothing;
        std::size_t number = 0;  ///< among its siblings
    };

    double distance(std::size_t left, std::size_t right) const {
        return (nodes_[left].width + nodes_[right].width) / 2;
    }
    std::size_t next_left(std::size_t v) const {
        return nodes_[v].children > 0 ? nodes_[v].first_child : work_[v].thread;
    }
    std::size_t next_right(std::size_t v) const {
        return nodes_[v].children > 0 ? nodes_[v].first_child + nodes_[v].children - 1 : work_[v].thread;
    }

    void first_walk(std::size_t v) {
        const TidyNode& node = nodes_[v];
        const std::size_t before = work_[v].number > 0 ? v - 1 : nothing;
        if (node.children == 0) {
            if (before != nothing) work_[v].prelim = work_[before].prelim + distance(before, v);
            return;
        }
        std::size_t default_ancestor = node.first_child;
        for (std::size_t k = 0; k < node.children; ++k) {
            const std::size_t child = node.first_child + k;
            first_walk(child);
            default_ancestor = apportion(child, default_ancestor);
        }
        execute_shifts(v);
        const std::size_t last = node.first_child + node.children - 1;
        const double middle = (work_[node.first_child].prelim + work_[last].prelim) / 2;
        if (before == nothing) {
            work_[v].prelim = middle;
        } else {
            work_[v].prelim = work_[before].prelim + distance(before, v);
            work_[v].mod = work_[v].prelim - middle;
        }
    }

    std::size_t apportion(std::size_t v, std::size_t default_ancestor) {
        if (work_[v].number == 0) return default_ancestor;
        std::size_t inner_right = v, outer_right = v;
        std::size_t inner_left = v - 1, outer_left = v - work_[v].number;
        double inner_right_sum = work_[v].mod, outer_right_sum = work_[v].mod;
        double inner_left_sum = work_[inner_left].mod, outer_left_sum = work_[outer_left].mod;
        while (next_right(inner_left) != nothing && next_left(inner_right) != nothing) {
            inner_left = next_right(inner_left);
            inner_right = next_left(inner_right);
            outer_left = next_left(outer_left);
            outer_right = next_right(outer_right);
            work_[outer_right].ancestor = v;
            const double shift = work_[inner_left].prelim + inner_left_sum - work_[inner_right].prelim -
                                 inner_right_sum + distance(inner_left, inner_right);
            if (shift > 0) {
                move_subtree(ancestor_of(inner_left, v, default_ancestor), v, shift);
                inner_right_sum += shift;
                outer_right_sum += shift;
            }
            inner_left_sum += work_[inner_left].mod;
            inner_right_sum += work_[inner_right].mod;
            outer_left_sum += work_[outer_left].mod;
            outer_right_sum += work_[outer_right].mod;
        }
        if (next_right(inner_left) != nothing && next_right(outer_right) == nothing) {
            work_[outer_right].thread = next_right(inner_left);
            work_[outer_right].mod += inner_left_sum - outer_right_sum;
        }
        if (next_left(inner_right) != nothing && next_left(outer_left) == nothing) {
            work_[outer_left].thread = next_left(inner_right);
            work_[outer_left].mod += inner_right_sum - outer_left_sum;
            return v;
        }
        return default_ancestor;
    }

    std::size_t ancestor_of(std::size_t left, std::size_t v, std::size_t default_ancestor) const {
        const std::size_t found = work_[left].ancestor;
        return work_[found].parent == work_[v].parent ? found : default_ancestor;
    }

    void move_subtree(std::size_t left, std::size_t right, double shift) {
        const double part = shift / static_cast<double>(work_[right].number - work_[left].number);
        work_[right].change -= part;
        work_[right].shift += shift;
        work_[left].change += part;
        work_[right].prelim += shift;
        work_[right].mod += shift;
    }

    void execute_shifts(std::size_t v) {
        double shift = 0, change = 0;
        for (std::size_t k = nodes_[v].children; k-- > 0;) {
            Work& child = work_[nodes_[v].first_child + k];
            child.prelim += shift;
            child.mod += shift;
            change += child.change;
            shift += child.shift + change;
        }
    }

    void second_walk(std::size_t v, double sum) {
        places_[v] = work_[v].prelim + sum;
        for (std::size_t k = 0; k < nodes_[v].children; ++k) {
            second_walk(nodes_[v].first_child + k, sum + work_[v].mod);
        }
    }

    const std::vector<TidyNode>& nodes_;
    std::vector<Work> work_;
    std::vector<double> places_;
};

}  // namespace

std::vector<double> tidy_places(const std::vector<TidyNode>& nodes) {
    return TidyPlaces(nodes).places();
}

}  // namespace sikku
