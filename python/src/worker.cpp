#include "worker.hpp"

namespace lichtmc::python {

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
}

}  // namespace lichtmc::python
