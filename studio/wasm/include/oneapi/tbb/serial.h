// studio/wasm/include/oneapi/tbb: the parts of oneTBB that the libraries use, on one thread. The headers beside this
// one include it under the names of oneTBB.
#pragma once

#include <cstddef>
#include <deque>
#include <type_traits>
#include <utility>

namespace oneapi::tbb {

namespace info {
inline int default_concurrency() {
    return 1;
}
}  // namespace info

class global_control {
public:
    enum parameter { max_allowed_parallelism };
    global_control(parameter /*limited*/, std::size_t /*value*/) {}
    ~global_control() {}  // not trivial, so that compilers do not report unused variables
};

class task_arena {
public:
    explicit task_arena(int /*threads*/ = 1) {}
    template <class Work>
    decltype(auto) execute(Work&& work) {
        return std::forward<Work>(work)();
    }
};

namespace this_task_arena {
inline int max_concurrency() {
    return 1;
}
}  // namespace this_task_arena

struct simple_partitioner {};

template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body, simple_partitioner = {}) {
    for (Index i = first; i < last; ++i) body(i);
}

template <class... Work>
void parallel_invoke(const Work&... work) {
    (work(), ...);
}

template <class Value>
class concurrent_queue {
public:
    void push(const Value& value) { values_.push_back(value); }
    bool try_pop(Value& value) {
        if (values_.empty()) return false;
        value = std::move(values_.front());
        values_.pop_front();
        return true;
    }

private:
    std::deque<Value> values_;
};

// --- pipelines: one item at a time passes all filters ----------------------------------------------------------

enum class filter_mode { serial_in_order, parallel };

class flow_control {
public:
    void stop() { is_stopped_ = true; }
    bool is_stopped() const { return is_stopped_; }

private:
    bool is_stopped_ = false;
};

template <class In, class Out, class Body>
struct filter {
    Body body;
};

template <class In, class Out, class Body>
filter<In, Out, Body> make_filter(filter_mode /*mode*/, const Body& body) {
    return {body};
}

template <class In, class Middle, class Out, class First, class Second>
auto operator&(const filter<In, Middle, First>& first, const filter<Middle, Out, Second>& second) {
    if constexpr (std::is_void_v<In>) {
        const auto both = [first, second](flow_control& control) -> Out {
            Middle item = first.body(control);
            if (control.is_stopped()) return Out();
            return second.body(std::move(item));
        };
        return filter<void, Out, decltype(both)>{both};
    } else {
        const auto both = [first, second](In item) { return second.body(first.body(std::move(item))); };
        return filter<In, Out, decltype(both)>{both};
    }
}

template <class Body>
void parallel_pipeline(std::size_t /*most_items*/, const filter<void, void, Body>& all) {
    for (flow_control control; !control.is_stopped();) all.body(control);
}

}  // namespace oneapi::tbb
