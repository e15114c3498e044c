#include "art/gallery/documents.h"

#include <exception>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_documents = 256;
constexpr std::size_t most_bytes = std::size_t{64} << 20;

}  // namespace

Document Documents::get(const std::string& key, std::size_t bytes, const std::function<Document()>& compile) {
    std::promise<Document> promise;
    std::shared_future<Document> document;
    bool is_first = false;
    {
        const std::lock_guard guard(mutex_);
        const auto found = known_.find(key);
        is_first = found == known_.end();
        if (is_first) {
            document = promise.get_future().share();
            used_.push_front({key, bytes, document});
            known_.emplace(key, used_.begin());
            bytes_ += bytes;
            ++compiled_;
            while (used_.size() > 1 && (used_.size() > most_documents || bytes_ > most_bytes)) {
                bytes_ -= used_.back().bytes;
                known_.erase(used_.back().key);
                used_.pop_back();
            }
        } else {
            used_.splice(used_.begin(), used_, found->second);
            document = found->second->document;
        }
    }
    if (is_first) {
        try {
            promise.set_value(compile());
        } catch (...) {
            promise.set_exception(std::current_exception());
        }
    }
    return document.get();
}

std::size_t Documents::compiled() const {
    const std::lock_guard guard(mutex_);
    return compiled_;
}

}  // namespace sikku
