// A room that Python code may change, and that results keep as it was when they were made.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string_view>
#include <type_traits>
#include <utility>

#include "lichtmc/prepared_room.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc::python {

// What hears of the steps of a preparation that this thread carries out; null: nothing does.
using StepListener = std::function<void(std::string_view)>;
inline thread_local const StepListener* step_listener = nullptr;

// A room, and what is known of its surfaces (lichtmc/prepared_room.hpp), which a second run then need not find again.
// Results and views hold it as const.
class KeptRoom {
 public:
  explicit KeptRoom(Room of) : room(std::move(of)) {}
  KeptRoom(const KeptRoom&) = delete;
  KeptRoom& operator=(const KeptRoom&) = delete;

  // For work on this number of threads (0: one per processor).
  std::shared_ptr<PreparedRoom> prepared(unsigned threads) const {
    const std::scoped_lock lock(mutex_);
    if (!prepared_ || threads_ != threads) {
      prepared_ = prepare(room, threads, [](std::string_view step) {
        if (step_listener != nullptr) (*step_listener)(step);
      });
      threads_ = threads;
    }
    return prepared_;
  }

  // Before the surfaces change.
  void forget_surfaces() { prepared_.reset(); }

  // When only results hold this room: there may be many of them, few of which are worked with again. If the room is
  // just being prepared, that is kept.
  void forget_preparation() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) prepared_.reset();
  }

  // Counts the SharedRooms that have this room: each holds it.
  std::shared_ptr<const char> shared_rooms() const { return shared_rooms_; }

  Room room;

 private:
  std::shared_ptr<const char> shared_rooms_ = std::make_shared<const char>();
  mutable std::mutex mutex_;
  mutable std::shared_ptr<PreparedRoom> prepared_;  // ends before the room
  mutable unsigned threads_ = 0;
};

// Copy on write: any number of results, views and copies share a room. A change is made in place if nothing else holds
// the room, so that a thousand changes of a large room cost no copies; else to a copy of its own.
//
// All functions are called with Python's lock. Work without the lock holds kept() meanwhile, and so sees no change.
class SharedRoom {
 public:
  explicit SharedRoom(Room room)
      : kept_(std::make_shared<KeptRoom>(std::move(room))), counted_(kept_->shared_rooms()) {}
  // What results hold. Rooms are never made const (make_shared<KeptRoom>), only held so: this class may change them.
  explicit SharedRoom(const std::shared_ptr<const KeptRoom>& kept)
      : kept_(std::const_pointer_cast<KeptRoom>(kept)), counted_(kept_->shared_rooms()) {}

  const Room& room() const { return kept_->room; }
  std::shared_ptr<const KeptRoom> kept() const { return kept_; }

  // Changes the room by change(Room&), and returns its value. The change must leave the room as it was if it throws,
  // and its surfaces as they are but for reflectances.
  template <class Change>
  decltype(auto) change(const Change& change) {
    take();
    return change(kept_->room);
  }

  // The same for a change of surfaces.
  template <class Change>
  decltype(auto) change_surfaces(const Change& change) {
    take();
    kept_->forget_surfaces();
    return change(kept_->room);
  }

  void replace(Room room) {
    constexpr long own = 2;  // counted_, and that of kept_
    if (counted_.use_count() == own) kept_->forget_preparation();
    kept_ = std::make_shared<KeptRoom>(std::move(room));
    counted_ = kept_->shared_rooms();
  }

 private:
  // Makes the room its own.
  void take() {
    if (kept_.use_count() > 1) {
      replace(Room(kept_->room));
    } else {
      // What others did with the room before they let go of it is over: use_count() alone does not say so.
      std::atomic_thread_fence(std::memory_order_acquire);
    }
  }

  std::shared_ptr<KeptRoom> kept_;
  std::shared_ptr<const char> counted_;
};

}  // namespace lichtmc::python
