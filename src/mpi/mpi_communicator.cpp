#include "lichtmc/mpi.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

#include <mpi.h>

#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

// MPI counts elements in int. With 2²⁴ elements per message, the latency of further messages is negligible.
constexpr std::size_t max_message_elements = std::size_t{1} << 24;

// Sum of 128-bit numbers, low word first: adds the carry of the low words to the high words.
void add_pairs(void* in, void* in_out, int* n, MPI_Datatype* /*type*/) {
  const auto* a = static_cast<const std::uint64_t*>(in);
  auto* b = static_cast<std::uint64_t*>(in_out);
  const std::size_t words = 2 * static_cast<std::size_t>(*n);
  for (std::size_t i = 0; i < words; i += 2) {
    const std::uint64_t low = a[i] + b[i];
    b[i + 1] += a[i + 1] + (low < b[i] ? 1 : 0);
    b[i] = low;
  }
}

// Open MPI, and launchers that use PMIx or PMI (srun, mpiexec of MPICH), set an environment variable.
bool started_by_mpi() {
  const char* const names[] = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
  return std::any_of(std::begin(names), std::end(names), [](const char* name) { return std::getenv(name) != nullptr; });
}

class ConnectedMpi final : public MpiCommunicator {
 public:
  ConnectedMpi() {
    int provided = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS ||
        provided < MPI_THREAD_FUNNELED) {
      throw RuntimeError(
          "Cannot start MPI with support for threads (required: MPI_THREAD_FUNNELED). Check the installation of MPI, "
          "or "
          "start lichtmc without mpirun.");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Type_contiguous(2, MPI_UINT64_T, &pair_);
    MPI_Type_commit(&pair_);
    MPI_Op_create(add_pairs, 1, &add_);
  }
  ~ConnectedMpi() override {
    MPI_Op_free(&add_);
    MPI_Type_free(&pair_);
    MPI_Finalize();
  }
  ConnectedMpi(const ConnectedMpi&) = delete;
  ConnectedMpi& operator=(const ConnectedMpi&) = delete;

  unsigned rank() const override { return static_cast<unsigned>(rank_); }
  unsigned size() const override { return static_cast<unsigned>(size_); }

  void sum(std::span<std::uint64_t> words) override {
    in_pieces(words.size(), [&](std::size_t first, int n) {
      MPI_Allreduce(MPI_IN_PLACE, words.data() + first, n, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    });
  }
  void sum_wide(std::span<std::uint64_t> words) override {
    in_pieces(words.size() / 2, [&](std::size_t first, int n) {
      MPI_Allreduce(MPI_IN_PLACE, words.data() + 2 * first, n, pair_, add_, MPI_COMM_WORLD);
    });
  }
  void broadcast(std::span<std::byte> bytes) override {
    in_pieces(bytes.size(),
              [&](std::size_t first, int n) { MPI_Bcast(bytes.data() + first, n, MPI_BYTE, 0, MPI_COMM_WORLD); });
  }

  [[noreturn]] void abort(int status) override {
    MPI_Abort(MPI_COMM_WORLD, status);
    std::_Exit(status);
  }

 private:
  template <class Send>
  static void in_pieces(std::size_t all, const Send& send) {
    for (std::size_t first = 0; first < all; first += max_message_elements)
      send(first, static_cast<int>(std::min(max_message_elements, all - first)));
  }

  int rank_ = 0;
  int size_ = 1;
  MPI_Datatype pair_ = MPI_DATATYPE_NULL;
  MPI_Op add_ = MPI_OP_NULL;
};

}  // namespace

std::unique_ptr<MpiCommunicator> join_mpi() {
  if (!started_by_mpi()) return nullptr;
  return std::make_unique<ConnectedMpi>();
}

}  // namespace lichtmc
