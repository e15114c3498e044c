// studio/bridge.h: the libraries behind one function of JSON and bytes, for hosts of other languages: the studio's
// page and its tests.
#pragma once

#include <string>

namespace sikku {

struct Reply {
    std::string json;   ///< UTF-8
    std::string bytes;  ///< outputs one after another, pixels, numbers; see studio/page/protocol.ts
};

/// Answers one request. studio/page/protocol.ts describes requests and answers. Never throws: failures are answers,
/// too. Keeps the documents of the last requests. For one thread.
/// @param json   at most 64 MB  @param bytes  the file that the request is about, at most 64 MB
Reply request(const std::string& json, const std::string& bytes);

}  // namespace sikku
