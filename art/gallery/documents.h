// art/gallery/documents.h: caches compiled patterns for all prints, scores and sheets of a gallery.
#pragma once

#include "engine/language/document.h"

#include <cstddef>
#include <functional>
#include <future>
#include <list>
#include <mutex>
#include <string>
#include <unordered_map>

namespace sikku {

/// A cache of the most recently used documents: at most 256, with at most 64 MB of text in total. Thread-safe.
class Documents {
public:
    /// Returns the document of that key, compiled by the first caller; others wait for it.
    /// @param bytes  size of its text
    /// @throws what `compile` throws, to every caller
    Document get(const std::string& key, std::size_t bytes, const std::function<Document()>& compile);
    /// Number of compilations so far.
    std::size_t compiled() const;

private:
    struct Entry {
        std::string key;
        std::size_t bytes;
        std::shared_future<Document> document;
    };
    mutable std::mutex mutex_;
    std::list<Entry> used_;  // most recently used first
    std::unordered_map<std::string, std::list<Entry>::iterator> known_;
    std::size_t bytes_ = 0;
    std::size_t compiled_ = 0;
};

}  // namespace sikku
