// engine/base/cost.h: estimated costs of works.
#pragma once

namespace sikku {

/// Estimated cost of a work in a program that makes nothing else.
struct Cost {
    double seconds = 0;         ///< processor time on the machine of docs/performance.md
    double bytes = 0;           ///< size of the outputs
    double memory = 0;          ///< peak memory in bytes
    double band = 0;            ///< additional bytes for each thread that renders pixels
    double shared_seconds = 0;  ///< part of `seconds` that all works of one program share
    double shared_memory = 0;   ///< part of `memory`, likewise
    bool is_doubtful = false;   ///< by its growth so far, a word that only deriving measures exceeds the budget
};

}  // namespace sikku
