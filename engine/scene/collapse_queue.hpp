// Vertices by the cost of removing them: a heap with four children a node, where a vertex's cost can change.
#pragma once

#include <cstdint>
#include <vector>

namespace dioptre {

class CollapseQueue {
  public:
    explicit CollapseQueue(std::size_t vertices) : place_(vertices, kAbsent) {}

    bool empty() const { return heap_.empty(); }
    std::uint32_t cheapest() const { return heap_.front().vertex; }
    float leastCost() const { return heap_.front().cost; }

    void set(std::uint32_t vertex, float cost) {
        const Entry entry{cost, vertex};
        std::uint32_t at = place_[vertex];
        if (at == kAbsent) {
            at = static_cast<std::uint32_t>(heap_.size());
            heap_.push_back(entry);
        }
        sift(at, entry);
    }
    void remove(std::uint32_t vertex) {
        const std::uint32_t at = place_[vertex];
        if (at == kAbsent) return;
        place_[vertex] = kAbsent;
        const Entry last = heap_.back();
        heap_.pop_back();
        if (at < heap_.size()) sift(at, last);
    }

  private:
    static constexpr std::uint32_t kAbsent = 0xFFFFFFFF, kChildren = 4;
    struct Entry {
        float cost;
        std::uint32_t vertex;
        // Equal costs in the order of the vertices: the same result everywhere
        bool before(const Entry& other) const {
            return cost < other.cost || (cost == other.cost && vertex < other.vertex);
        }
    };

    void put(std::uint32_t at, const Entry& entry) {
        heap_[at] = entry;
        place_[entry.vertex] = at;
    }
    /// Puts an entry where it belongs, given a place whose own entry is not needed any more.
    void sift(std::uint32_t at, const Entry& entry) {
        while (at > 0 && entry.before(heap_[(at - 1) / kChildren])) {
            put(at, heap_[(at - 1) / kChildren]);
            at = (at - 1) / kChildren;
        }
        const auto size = static_cast<std::uint32_t>(heap_.size());
        for (std::uint32_t child; (child = kChildren * at + 1) < size;) {
            std::uint32_t least = child;
            for (std::uint32_t c = child + 1; c < size && c < child + kChildren; ++c)
                if (heap_[c].before(heap_[least])) least = c;
            if (!heap_[least].before(entry)) break;
            put(at, heap_[least]);
            at = least;
        }
        put(at, entry);
    }

    std::vector<Entry> heap_;
    std::vector<std::uint32_t> place_;  // of each vertex, in the heap
};

}  // namespace dioptre
