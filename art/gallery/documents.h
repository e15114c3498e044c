// art/gallery/documents.h: keeps compiled patterns, so that the prints, scores and sheets of a pattern share one.
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

/// The documents used last: at most 256, of at most 64 MB of text together. For several threads.
class Documents {
public:
    /// Returns the document of that key, compiled by the first caller; others wait for it.
    /// @param bytes  size of its text
    /// @throws what `compile` throws, to every caller
    Document get(const std::string& key, std::size_t bytes, const std::function<Document()>& compile);
    /// How often a document was compiled.
    std::size_t compiled() const;

private:
    struct Entry {
        std::string key;
        std::size_t bytes;
        std::shared_future<Document> document;
    };
    mutable std::mutex mutex_;
    std::list<Entry> used_;  // the last one first
    std::unordered_map<std::string, std::list<Entry>::iterator> known_;
    std::size_t bytes_ = 0;
    std::size_t compiled_ = 0;
};

}  // namespace sikku
