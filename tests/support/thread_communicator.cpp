#include "support/thread_communicator.hpp"

#include <algorithm>
#include <thread>

namespace lichtmc::test {

namespace {

__extension__ using Wide = unsigned __int128;

// Ranks store their data here; when all have, each reads what it needs.
class Table {
 public:
  explicit Table(unsigned size) : spans_(size), barrier_(size) {}

  void put(unsigned rank, std::span<std::byte> bytes) {
    spans_[rank] = bytes;
    barrier_.arrive_and_wait();
  }
  template <class Word>
  const Word* words_of(std::size_t rank) const {
    return reinterpret_cast<const Word*>(spans_[rank].data());
  }
  std::span<const std::byte> bytes_of(std::size_t rank) const { return spans_[rank]; }
  // No rank may change data that others still read.
  void all_have_read() { barrier_.arrive_and_wait(); }
  std::size_t size() const { return spans_.size(); }

 private:
  std::vector<std::span<std::byte>> spans_;
  std::barrier<> barrier_;
};

class ThreadCommunicator final : public Communicator {
 public:
  ThreadCommunicator(Table& table, unsigned rank) : table_(&table), rank_(rank) {}

  unsigned rank() const override { return rank_; }
  unsigned size() const override { return static_cast<unsigned>(table_->size()); }
  void sum(std::span<std::uint64_t> words) override { reduce(words.data(), words.size()); }
  void sum_wide(std::span<std::uint64_t> words) override {
    reduce(reinterpret_cast<Wide*>(words.data()), words.size() / 2);
  }
  void broadcast(std::span<std::byte> bytes) override {
    table_->put(rank_, bytes);
    const std::span<const std::byte> first = table_->bytes_of(0);
    if (rank_ > 0) std::copy(first.begin(), first.end(), bytes.begin());
    table_->all_have_read();
  }

 private:
  template <class Word>
  void reduce(Word* words, std::size_t n) {
    table_->put(rank_, std::as_writable_bytes(std::span(words, n)));
    std::vector<Word> sum(n, 0);
    for (std::size_t k = 0; k < table_->size(); ++k) {
      const Word* theirs = table_->words_of<Word>(k);
      for (std::size_t i = 0; i < n; ++i) sum[i] += theirs[i];
    }
    table_->all_have_read();
    std::copy(sum.begin(), sum.end(), words);
  }

  Table* table_;
  unsigned rank_;
};

}  // namespace

void run_ranks(unsigned size, const std::function<void(Communicator&)>& work) {
  Table table(size);
  std::vector<std::jthread> members;
  for (unsigned rank = 0; rank < size; ++rank) {
    members.emplace_back([&table, &work, rank] {
      ThreadCommunicator member(table, rank);
      work(member);
    });
  }
}

}  // namespace lichtmc::test
