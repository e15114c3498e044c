// art/gallery/documents.h: caches compiled patterns for all prints, scores and sheets of a gallery, and works planned
// for forecasts until they are made.
#pragma once

#include "engine/interpreter.h"
#include "engine/language/document.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

namespace sikku {

/// A cache of the most recently used documents: at most 256, with at most 64 MB of text in total. Thread-safe.
class Documents {
public:
    /// Returns the document of that key, compiled by the first caller; others wait for it.
    /// @param bytes  size of its text
    /// @throws exceptions of `compile`, to every caller
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

/// A cache of planned works until they are made, with at most 64 MB of text in total; works that do not fit are
/// planned again. Thread-safe.
class Works {
public:
    /// Returns the work of that key. @param bytes  size of its text  @throws exceptions of `plan`
    std::shared_ptr<Work> get(const std::string& key, std::size_t bytes,
                              const std::function<std::unique_ptr<Work>()>& plan);
    void forget(const std::string& key);
    /// The hash of a file of up to 16 MB that works read, computed once; empty if it cannot be read, which the work
    /// itself reports.
    std::string digits_of(const std::filesystem::path& file);
    /// Number of works planned so far.
    std::size_t planned() const;

private:
    struct Entry {
        std::shared_ptr<Work> work;
        std::size_t bytes;
    };
    mutable std::mutex mutex_;
    std::unordered_map<std::string, Entry> known_;
    std::map<std::filesystem::path, std::string> digits_;
    std::size_t bytes_ = 0;
    std::size_t planned_ = 0;
};

}  // namespace sikku
