#include "worker.hpp"

#include <unistd.h>

#include <algorithm>

#include "bindings.hpp"

namespace lichtmc::python {

namespace {

// The thread that ends Python; functions that it calls later may still work.
std::thread::id ending_thread;

bool is_ended() {
  return ending_thread != std::thread::id() && ending_thread != std::this_thread::get_id();
}

[[noreturn]] void raise_system_exit() {
  PyErr_SetNone(PyExc_SystemExit);  // which threading does not report
  throw nb::python_error();
}

}  // namespace

CallingThread::CallingThread(std::stop_source stop, Interrupted interrupted)
    : process_(getpid()), stop_(std::move(stop)), policy_(interrupted) {
  if (is_ended()) raise_system_exit();
  running().push_back(this);
}

CallingThread::~CallingThread() {
  std::erase(running(), this);
}

std::vector<CallingThread*>& CallingThread::running() {
  static std::vector<CallingThread*> threads;
  return threads;
}

void CallingThread::end_all() {
  ending_thread = std::this_thread::get_id();
  const auto is_here = [process = getpid()](const CallingThread* one) { return one->process_ == process; };
  for (CallingThread* one : running()) {
    if (is_here(one)) one->stop_.request_stop();
  }
  // A callback that waits for ever must not keep the program: work itself stops within seconds.
  constexpr std::chrono::seconds longest{30};
  const auto limit = std::chrono::steady_clock::now() + longest;
  while (std::ranges::any_of(running(), is_here) && std::chrono::steady_clock::now() < limit) {
    const nb::gil_scoped_release without_lock;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void CallingThread::visit_python(const std::function<void()>& call) noexcept {
  const nb::gil_scoped_acquire lock;
  try {
    if (!error_) call();
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  } catch (const nb::python_error& error) {
    if (!interrupt_ && policy_ == Interrupted::returns && error.matches(PyExc_KeyboardInterrupt)) {
      interrupt_ = std::current_exception();
      stop_.request_stop();
    } else {
      note(std::current_exception());
    }
  } catch (...) {
    note(std::current_exception());
  }
}

void CallingThread::note(std::exception_ptr error) {
  if (!error_) error_ = std::move(error);
  stop_.request_stop();
}

void CallingThread::raise(bool failed) const {
  if (error_) std::rethrow_exception(error_);
  if (failed && interrupt_) std::rethrow_exception(interrupt_);
  if (is_ended()) raise_system_exit();
}

void bind_worker(nb::module_& module) {
  module.def("_end_all_work", &CallingThread::end_all);
  nb::module_::import_("atexit").attr("register")(module.attr("_end_all_work"));
}

}  // namespace lichtmc::python
