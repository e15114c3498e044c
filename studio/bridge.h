// studio/bridge.h: the libraries as one function of JSON and bytes, for callers in other languages: the studio page
// and its tests.
#pragma once

#include <string>

namespace sikku {

struct Reply {
    std::string json;   ///< UTF-8
    std::string bytes;  ///< outputs in sequence, pixels or numbers; see studio/page/protocol.ts
};

/// Answers a request; studio/page/protocol.ts describes requests and answers. Never throws: errors are answers, too.
/// Caches the documents of the last requests. Not thread-safe.
/// @param json   at most 64 MB  @param bytes  the file that the request refers to, at most 64 MB
Reply request(const std::string& json, const std::string& bytes);

}  // namespace sikku
