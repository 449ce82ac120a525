// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/sundials/SundialsStepper.hpp"

#include <algorithm>
#include <arkode/arkode_arkstep.h>
#include <cmath>
#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <exception>
#include <nvector/nvector_serial.h>
#include <stdexcept>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include "common/Error.hpp"

namespace tooljoint::transient {
namespace {

/// Tries of one step before SUNDIALS gives up; impacts and stick-slip need more than its defaults
/// of 7 and 10.
constexpr int maxTries = 40;

/// Common parts of both solvers: context, vectors, the Newton matrix as a SUNMatrix without entries
/// and its solver, callbacks that keep exceptions of the model out of C.
class Stepper : public SundialsStepper {
 public:
  Stepper(FirstOrderForm& form, const SundialsOptions& options) : form_(form), options_(options) {
    if (SUNContext_Create(nullptr, &context_) != 0)
      throw std::runtime_error("SUNDIALS cannot create its context");
    y_ = N_VNew_Serial(form.size(), context_);
    work_ = N_VNew_Serial(form.size(), context_);
    matrix_ = SUNMatNewEmpty(context_);
    matrix_->content = this;
    matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    solver_ = SUNLinSolNewEmpty(context_);
    solver_->content = this;
    solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    solver_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
    solver_->ops->initialize = [](SUNLinearSolver) { return 0; };
    solver_->ops->setup = [](SUNLinearSolver s, SUNMatrix) {
      return self(s->content).regular_ ? 0 : 1;
    };
    solver_->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, realtype) {
      return self(s->content).solve(x, b);
    };
  }
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;
  ~Stepper() override {
    SUNLinSolFreeEmpty(solver_);
    SUNMatFreeEmpty(matrix_);
    for (N_Vector each : {y_, work_}) N_VDestroy(each);
    SUNContext_Free(&context_);
  }

  double time() const override { return time_; }
  double lastStep() const override { return length_; }
  const std::string& message() const override { return message_; }

 protected:
  static Stepper& self(void* data) { return *static_cast<Stepper*>(data); }
  static double* data(N_Vector x) { return N_VGetArrayPointer(x); }

  /// yDot = f(t, y). Returns 0; 1 if it is not finite or a law fails (a shorter step may help); -1
  /// if the model threw something else.
  static int rightHandSide(realtype t, N_Vector y, N_Vector yDot, void* me) {
    return self(me).guarded([&](FirstOrderForm& form) {
      try {
        form.rightHandSide(t, data(y), data(yDot));
      } catch (const ConvergenceError&) {
        self(me).refused_ = std::current_exception();
        return 1;
      }
      return isFinite(yDot) ? 0 : 1;
    });
  }
  static int weights(N_Vector y, N_Vector weight, void* me) {
    const Stepper& stepper = self(me);
    for (int i = 0; i < stepper.form_.size(); ++i)
      data(weight)[i] = 1.0 / stepper.allowed(i, data(y)[i]);
    return 0;
  }
  int formNewtonMatrix(realtype t, N_Vector y, booleantype* fresh, realtype gamma) {
    *fresh = SUNTRUE;
    return guarded([&](FirstOrderForm& form) {
      regular_ = form.factor(t, data(y), gamma);
      return 0;
    });
  }
  int solve(N_Vector x, N_Vector b) {
    if (x != b) N_VScale(1.0, b, x);
    return guarded([&](FirstOrderForm& form) {
      form.solve(data(x));
      return isFinite(x) ? 0 : 1;
    });
  }
  static void listen(int, const char*, const char*, char* text, void* me) {
    self(me).message_ = text;
  }

  void load(double t, const double* y) {
    std::copy_n(y, form_.size(), data(y_));
    time_ = t;
    length_ = 0;
  }
  void unload(N_Vector from, double* y) const { std::copy_n(data(from), form_.size(), y); }
  double allowed(int i, double y) const {
    const int n = form_.dofs();
    return i >= n && i < 2 * n ? options_.allowedVelocity(y) : options_.allowedPosition(y);
  }
  /// Position of the largest error in work_, weighted by y.
  int worst() const {
    int position = 0;
    double largest = -1;
    for (int i = 0; i < form_.size(); ++i) {
      const double size = std::abs(data(work_)[i]) / allowed(i, data(y_)[i]);
      if (!std::isfinite(size)) return i;
      if (size > largest) largest = size, position = i;
    }
    return position;
  }
  void require(int flag, const char* call) const {
    if (flag < 0) throw std::runtime_error(std::string(call) + " of SUNDIALS failed: " + message_);
  }
  /// \param flag result of the step: after a failed one the last exception of a law is rethrown
  void rethrow(int flag = 0) {
    if (!thrown_ && flag < 0) thrown_ = refused_;
    refused_ = nullptr;
    if (!thrown_) return;
    const auto thrown = thrown_;
    thrown_ = nullptr;
    std::rethrow_exception(thrown);
  }

  FirstOrderForm& form_;
  SundialsOptions options_;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr, work_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  double time_ = 0, length_ = 0;
  std::string message_;

 private:
  /// The sum is finite if all entries are, except for an overflow, which is no valid motion either.
  static bool isFinite(N_Vector x) {
    double sum = 0;
    const double* values = data(x);
    for (sunindextype i = 0; i < N_VGetLength(x); ++i) sum += std::abs(values[i]);
    return std::isfinite(sum);
  }
  template <class Work>
  int guarded(const Work& work) {
    try {
      return work(form_);
    } catch (...) {
      thrown_ = std::current_exception();
      return -1;
    }
  }
  bool regular_ = false;
  std::exception_ptr thrown_, refused_;
};

/// ARKStep, all terms implicit.
class Arkode final : public Stepper {
 public:
  Arkode(FirstOrderForm& form, const SundialsOptions& options) : Stepper(form, options) {
    for (N_Vector* each : {&from_, &fromRate_, &rate_}) *each = N_VClone(y_);
  }
  ~Arkode() override {
    ARKStepFree(&memory_);
    for (N_Vector each : {from_, fromRate_, rate_}) N_VDestroy(each);
  }

  void restart(double t, const double* y, double end, double firstStep) override {
    load(t, y);
    if (memory_ == nullptr)
      create(t);
    else
      require(ARKStepReInit(memory_, nullptr, rightHandSide, t, y_), "ARKStepReInit");
    require(ARKStepSetInitStep(memory_, firstStep), "ARKStepSetInitStep");
    end_ = end;
  }
  void stopAt(double t) override { require(ARKStepSetStopTime(memory_, t), "ARKStepSetStopTime"); }

  SundialsTrouble step() override {
    interpolates_ = false;
    const int flag = ARKStepEvolve(memory_, end_, y_, &time_, ARK_ONE_STEP);
    rethrow(flag);
    if (flag >= 0) {
      require(ARKStepGetLastStep(memory_, &length_), "ARKStepGetLastStep");
      return SundialsTrouble::None;
    }
    switch (flag) {
      case ARK_TOO_MUCH_ACC:
        return SundialsTrouble::Accuracy;
      case ARK_ERR_FAILURE:
        return SundialsTrouble::ErrorTest;
      case ARK_CONV_FAILURE:
      case ARK_LSETUP_FAIL:
      case ARK_LSOLVE_FAIL:
        return SundialsTrouble::Newton;
      case ARK_FIRST_RHSFUNC_ERR:
      case ARK_REPTD_RHSFUNC_ERR:
      case ARK_UNREC_RHSFUNC_ERR:
        return SundialsTrouble::NotFinite;
      default:
        return SundialsTrouble::Other;
    }
  }

  double nextStep() const override {
    double h = 0;
    require(ARKStepGetCurrentStep(memory_, &h), "ARKStepGetCurrentStep");
    return h;
  }
  /// The interpolation of ARKODE is of third degree, less accurate than the methods. q, v and a at
  /// both ends of the step give one of fifth degree. States of point laws use third degree.
  void at(double t, double* y) override {
    if (t == time_) return unload(y_, y);
    if (!interpolates_) {
      require(ARKStepGetDky(memory_, time_ - length_, 0, from_), "ARKStepGetDky");
      require(ARKStepGetDky(memory_, time_ - length_, 1, fromRate_), "ARKStepGetDky");
      require(ARKStepGetDky(memory_, time_, 1, rate_), "ARKStepGetDky");
      rethrow();
      interpolates_ = true;
    }
    const double h = length_;
    const double x = (t - (time_ - h)) / h;
    const int n = form_.dofs();
    const double p = x * x * x * (10 - x * (15 - 6 * x)), dp = 30 * x * x * (1 - x) * (1 - x) / h;
    const double v0 = h * x * (1 - x * x * (6 - x * (8 - 3 * x))),
                 dv0 = 1 - x * x * (18 - x * (32 - 15 * x));
    const double v1 = -h * x * x * x * (4 - x * (7 - 3 * x)),
                 dv1 = -x * x * (12 - x * (28 - 15 * x));
    const double a0 = 0.5 * h * h * x * x * (1 - x * (3 - x * (3 - x))),
                 da0 = 0.5 * h * x * (2 - x * (9 - x * (12 - 5 * x)));
    const double a1 = 0.5 * h * h * x * x * x * (1 - x * (2 - x)),
                 da1 = 0.5 * h * x * x * (3 - x * (8 - 5 * x));
    const double *Y0 = data(from_), *F0 = data(fromRate_), *Y1 = data(y_), *F1 = data(rate_);
    for (int i = 0, k = n; i < n; ++i, ++k) {
      const double step = Y1[i] - Y0[i];
      y[i] = Y0[i] + p * step + v0 * Y0[k] + v1 * Y1[k] + a0 * F0[k] + a1 * F1[k];
      y[k] = dp * step + dv0 * Y0[k] + dv1 * Y1[k] + da0 * F0[k] + da1 * F1[k];
    }
    const double h01 = x * x * (3 - 2 * x), h10 = h * x * (1 - x) * (1 - x),
                 h11 = h * x * x * (x - 1);
    for (int i = 2 * n; i < form_.size(); ++i)
      y[i] = Y0[i] + h01 * (Y1[i] - Y0[i]) + h10 * F0[i] + h11 * F1[i];
  }
  SundialsCounts counts() const override {
    SundialsCounts c;
    require(ARKStepGetNumErrTestFails(memory_, &c.rejected), "ARKStepGetNumErrTestFails");
    require(ARKStepGetNumStepSolveFails(memory_, &c.newtonFailures), "ARKStepGetNumStepSolveFails");
    require(ARKStepGetNumNonlinSolvIters(memory_, &c.newtonIterations),
            "ARKStepGetNumNonlinSolvIters");
    return c;
  }
  int worstPosition() override {
    return ARKStepGetEstLocalErrors(memory_, work_) < 0 ? 0 : worst();
  }

 private:
  static int newtonMatrix(realtype t, N_Vector y, N_Vector, SUNMatrix, SUNMatrix, booleantype,
                          booleantype* fresh, realtype gamma, void* me, N_Vector, N_Vector,
                          N_Vector) {
    return static_cast<Arkode*>(&self(me))->formNewtonMatrix(t, y, fresh, gamma);
  }
  void create(double t) {
    memory_ = ARKStepCreate(nullptr, rightHandSide, t, y_, context_);
    if (memory_ == nullptr) throw std::runtime_error("ARKStepCreate of SUNDIALS failed");
    require(ARKStepSetErrHandlerFn(memory_, listen, this), "ARKStepSetErrHandlerFn");
    require(ARKStepSetUserData(memory_, static_cast<Stepper*>(this)), "ARKStepSetUserData");
    require(ARKStepWFtolerances(memory_, weights), "ARKStepWFtolerances");
    require(ARKStepSetTableName(memory_, ("ARKODE_" + options_.table).c_str(), "ARKODE_ERK_NONE"),
            "ARKStepSetTableName");
    require(ARKStepSetLinearSolver(memory_, solver_, matrix_), "ARKStepSetLinearSolver");
    require(ARKStepSetLinSysFn(memory_, newtonMatrix), "ARKStepSetLinSysFn");
    require(ARKStepSetMaxNonlinIters(memory_, options_.maxIterations), "ARKStepSetMaxNonlinIters");
    // ARKODE accepts a first correction if earlier corrections converged fast, even if the factor
    // belongs to another gamma.
    require(ARKStepSetDeltaGammaMax(memory_, 1e-6), "ARKStepSetDeltaGammaMax");
    // The convergence rate of earlier corrections is no measure either where dry friction may
    // reverse: a bit at rest was found to turn at 70 rad/s. With 1 each correction is measured by
    // its own size.
    require(ARKStepSetNonlinCRDown(memory_, 1.0), "ARKStepSetNonlinCRDown");
    require(ARKStepSetMaxErrTestFails(memory_, maxTries), "ARKStepSetMaxErrTestFails");
    require(ARKStepSetMaxConvFails(memory_, maxTries), "ARKStepSetMaxConvFails");
    if (options_.maxStep > 0)
      require(ARKStepSetMaxStep(memory_, options_.maxStep), "ARKStepSetMaxStep");
  }
  void* memory_ = nullptr;
  double end_ = 0;
  N_Vector from_ = nullptr, fromRate_ = nullptr,
           rate_ = nullptr;    ///< y and f at the start of the last step, f at its end
  bool interpolates_ = false;  ///< they belong to the last step
};

/// CVODE, backward differentiation formulas.
class Cvode final : public Stepper {
 public:
  using Stepper::Stepper;
  ~Cvode() override { CVodeFree(&memory_); }

  void restart(double t, const double* y, double end, double firstStep) override {
    load(t, y);
    if (memory_ == nullptr)
      create(t);
    else
      require(CVodeReInit(memory_, t, y_), "CVodeReInit");
    require(CVodeSetInitStep(memory_, firstStep), "CVodeSetInitStep");
    end_ = end;
  }
  void stopAt(double t) override { require(CVodeSetStopTime(memory_, t), "CVodeSetStopTime"); }

  SundialsTrouble step() override {
    const int flag = CVode(memory_, end_, y_, &time_, CV_ONE_STEP);
    rethrow(flag);
    if (flag >= 0) {
      require(CVodeGetLastStep(memory_, &length_), "CVodeGetLastStep");
      return SundialsTrouble::None;
    }
    switch (flag) {
      case CV_TOO_MUCH_ACC:
        return SundialsTrouble::Accuracy;
      case CV_ERR_FAILURE:
        return SundialsTrouble::ErrorTest;
      case CV_CONV_FAILURE:
      case CV_LSETUP_FAIL:
      case CV_LSOLVE_FAIL:
        return SundialsTrouble::Newton;
      case CV_FIRST_RHSFUNC_ERR:
      case CV_REPTD_RHSFUNC_ERR:
      case CV_UNREC_RHSFUNC_ERR:
        return SundialsTrouble::NotFinite;
      default:
        return SundialsTrouble::Other;
    }
  }

  double nextStep() const override {
    double h = 0;
    require(CVodeGetCurrentStep(memory_, &h), "CVodeGetCurrentStep");
    return h;
  }
  void at(double t, double* y) override {
    if (t == time_) return unload(y_, y);
    require(CVodeGetDky(memory_, t, 0, work_), "CVodeGetDky");
    unload(work_, y);
  }
  SundialsCounts counts() const override {
    SundialsCounts c;
    require(CVodeGetNumErrTestFails(memory_, &c.rejected), "CVodeGetNumErrTestFails");
    require(CVodeGetNumStepSolveFails(memory_, &c.newtonFailures), "CVodeGetNumStepSolveFails");
    require(CVodeGetNumNonlinSolvIters(memory_, &c.newtonIterations), "CVodeGetNumNonlinSolvIters");
    return c;
  }
  int worstPosition() override { return CVodeGetEstLocalErrors(memory_, work_) < 0 ? 0 : worst(); }

 private:
  static int newtonMatrix(realtype t, N_Vector y, N_Vector, SUNMatrix, booleantype,
                          booleantype* fresh, realtype gamma, void* me, N_Vector, N_Vector,
                          N_Vector) {
    return static_cast<Cvode*>(&self(me))->formNewtonMatrix(t, y, fresh, gamma);
  }
  void create(double t) {
    memory_ = CVodeCreate(CV_BDF, context_);
    if (memory_ == nullptr) throw std::runtime_error("CVodeCreate of SUNDIALS failed");
    require(CVodeSetErrHandlerFn(memory_, listen, this), "CVodeSetErrHandlerFn");
    require(CVodeInit(memory_, rightHandSide, t, y_), "CVodeInit");
    require(CVodeSetUserData(memory_, static_cast<Stepper*>(this)), "CVodeSetUserData");
    require(CVodeWFtolerances(memory_, weights), "CVodeWFtolerances");
    require(CVodeSetMaxOrd(memory_, options_.maxOrder), "CVodeSetMaxOrd");
    require(CVodeSetLinearSolver(memory_, solver_, matrix_), "CVodeSetLinearSolver");
    require(CVodeSetLinSysFn(memory_, newtonMatrix), "CVodeSetLinSysFn");
    require(CVodeSetMaxNonlinIters(memory_, options_.maxIterations), "CVodeSetMaxNonlinIters");
    require(CVodeSetMaxErrTestFails(memory_, maxTries), "CVodeSetMaxErrTestFails");
    require(CVodeSetMaxConvFails(memory_, maxTries), "CVodeSetMaxConvFails");
    if (options_.maxStep > 0)
      require(CVodeSetMaxStep(memory_, options_.maxStep), "CVodeSetMaxStep");
  }
  void* memory_ = nullptr;
  double end_ = 0;
};

}  // namespace

std::unique_ptr<SundialsStepper> makeArkode(FirstOrderForm& form, const SundialsOptions& options) {
  return std::make_unique<Arkode>(form, options);
}

std::unique_ptr<SundialsStepper> makeCvode(FirstOrderForm& form, const SundialsOptions& options) {
  return std::make_unique<Cvode>(form, options);
}

}  // namespace tooljoint::transient
