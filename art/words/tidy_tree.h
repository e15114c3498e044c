// art/words/tidy_tree.h: places the nodes of ordered trees.
#pragma once

#include <cstddef>
#include <vector>

namespace sikku {

/// A node of an ordered tree whose nodes are numbered level by level, from left to right: its children follow each
/// other.
struct TidyNode {
    std::size_t first_child = 0;
    std::size_t children = 0;
    double width = 1;  ///< with the space around it
};

/// Returns the centre of each node. Node 0 is the root. Subtrees are as close as their outlines allow, parents are
/// centred above their children, and equal subtrees are placed alike. Cost: linear; the depth is that of the stack.
/// Source: Buchheim, Jünger & Leipert, Improving Walker's algorithm to run in linear time, Graph Drawing 2002.
std::vector<double> tidy_places(const std::vector<TidyNode>& nodes);

}  // namespace sikku
