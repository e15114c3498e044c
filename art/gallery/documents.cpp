#include "art/gallery/documents.h"

#include "engine/base/hash.h"
#include "engine/base/input_file.h"

#include <exception>
#include <system_error>

namespace sikku {
namespace {

constexpr std::size_t most_documents = 256;
constexpr std::size_t most_bytes = std::size_t{64} << 20;
constexpr std::uint64_t most_hashed_bytes = std::uint64_t{16} << 20;
constexpr std::size_t work_bytes = 8192;  // memory of a planned work without its text

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

std::shared_ptr<Work> Works::get(const std::string& key, std::size_t bytes,
                                 const std::function<std::unique_ptr<Work>()>& plan) {
    {
        const std::lock_guard guard(mutex_);
        if (const auto found = known_.find(key); found != known_.end()) return found->second.work;
    }
    std::shared_ptr<Work> work = plan();
    const std::lock_guard guard(mutex_);
    ++planned_;
    bytes += work_bytes + key.size();
    if (bytes_ + bytes <= most_bytes && known_.emplace(key, Entry{work, bytes}).second) bytes_ += bytes;
    return work;
}

void Works::forget(const std::string& key) {
    const std::lock_guard guard(mutex_);
    const auto found = known_.find(key);
    if (found == known_.end()) return;
    bytes_ -= found->second.bytes;
    known_.erase(found);
}

std::string Works::digits_of(const std::filesystem::path& file) {
    const std::lock_guard guard(mutex_);
    const auto [entry, is_new] = digits_.try_emplace(file);
    if (!is_new) return entry->second;
    try {
        const InputFile input(file);
        if (input.size() > most_hashed_bytes) return {};
        TextHash hash;
        hash.add(input.read(0, input.size()));
        entry->second = hash.digits();
    } catch (const std::system_error&) {
    }
    return entry->second;
}

std::size_t Works::planned() const {
    const std::lock_guard guard(mutex_);
    return planned_;
}

}  // namespace sikku
