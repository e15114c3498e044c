#include "art/relief/windings.h"

#include <utility>

namespace sikku {

Windings::Windings() {
    number({});
}

Windings::Id Windings::number(const Set& set) {
    if (const auto known = ids_.find(set); known != ids_.end()) return known->second;
    Set opposite = set;
    for (Winding& winding : opposite) winding.count = -winding.count;
    const Id id = static_cast<Id>(sets_.size());
    sets_.push_back(set);
    ids_.emplace(set, id);
    if (opposite == set) {
        negatives_.push_back(id);
    } else {
        sets_.push_back(opposite);
        ids_.emplace(std::move(opposite), id + 1);
        negatives_.insert(negatives_.end(), {id + 1, id});
    }
    return id;
}

Windings::Id Windings::sum(Id a, Id b) {
    if (a == 0) return b;
    if (b == 0) return a;
    if (a > b) std::swap(a, b);
    const std::uint64_t key = std::uint64_t{a} << 32 | b;
    if (const auto known = sums_.find(key); known != sums_.end()) return known->second;
    Set result;
    const Set &one = sets_[a], &two = sets_[b];
    for (std::size_t i = 0, k = 0; i < one.size() || k < two.size();) {
        if (k == two.size() || (i < one.size() && one[i].layer < two[k].layer)) {
            result.push_back(one[i++]);
        } else if (i == one.size() || two[k].layer < one[i].layer) {
            result.push_back(two[k++]);
        } else {
            const std::int32_t count = one[i].count + two[k].count;
            if (count != 0) result.push_back({one[i].layer, count});
            ++i;
            ++k;
        }
    }
    return sums_[key] = number(result);
}

}  // namespace sikku
