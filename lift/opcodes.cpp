#include "lift/opcodes.hpp"

#include <llvm/IR/Operator.h>

#include <string>

#include "lift/value.hpp"

namespace veritrack::lift {

Operation operation_of(unsigned opcode) {
  using Op = llvm::Instruction;
  switch (opcode) {
    case Op::FAdd:
      return Operation::fadd;
    case Op::FSub:
      return Operation::fsub;
    case Op::FMul:
      return Operation::fmul;
    case Op::FDiv:
      return Operation::fdiv;
    case Op::FRem:
      return Operation::fmod;
    case Op::FNeg:
      return Operation::fneg;
    case Op::Add:
      return Operation::add;
    case Op::Sub:
      return Operation::sub;
    case Op::Mul:
      return Operation::mul;
    case Op::UDiv:
      return Operation::udiv;
    case Op::SDiv:
      return Operation::sdiv;
    case Op::URem:
      return Operation::urem;
    case Op::SRem:
      return Operation::srem;
    case Op::And:
      return Operation::bit_and;
    case Op::Or:
      return Operation::bit_or;
    case Op::Xor:
      return Operation::bit_xor;
    case Op::Shl:
      return Operation::shl;
    case Op::LShr:
      return Operation::lshr;
    case Op::AShr:
      return Operation::ashr;
    case Op::FPExt:
      return Operation::fpext;
    case Op::FPTrunc:
      return Operation::fptrunc;
    case Op::SIToFP:
      return Operation::sitofp;
    case Op::UIToFP:
      return Operation::uitofp;
    case Op::FPToSI:
      return Operation::fptosi;
    case Op::FPToUI:
      return Operation::fptoui;
    case Op::ZExt:
      return Operation::zext;
    case Op::SExt:
      return Operation::sext;
    case Op::Trunc:
      return Operation::integer_trunc;
    default:
      throw LiftError(std::string("an operation that is not followed: ") +
                      llvm::Instruction::getOpcodeName(opcode));
  }
}

Predicate predicate_of(llvm::CmpInst::Predicate predicate) {
  using Cmp = llvm::CmpInst;
  switch (predicate) {
    case Cmp::FCMP_OEQ:
      return Predicate::oeq;
    case Cmp::FCMP_ONE:
      return Predicate::one;
    case Cmp::FCMP_OLT:
      return Predicate::olt;
    case Cmp::FCMP_OLE:
      return Predicate::ole;
    case Cmp::FCMP_OGT:
      return Predicate::ogt;
    case Cmp::FCMP_OGE:
      return Predicate::oge;
    case Cmp::FCMP_ORD:
      return Predicate::ord;
    case Cmp::FCMP_UEQ:
      return Predicate::ueq;
    case Cmp::FCMP_UNE:
      return Predicate::une;
    case Cmp::FCMP_ULT:
    case Cmp::ICMP_ULT:
      return Predicate::ult;
    case Cmp::FCMP_ULE:
    case Cmp::ICMP_ULE:
      return Predicate::ule;
    case Cmp::FCMP_UGT:
    case Cmp::ICMP_UGT:
      return Predicate::ugt;
    case Cmp::FCMP_UGE:
    case Cmp::ICMP_UGE:
      return Predicate::uge;
    case Cmp::FCMP_UNO:
      return Predicate::uno;
    case Cmp::ICMP_EQ:
      return Predicate::eq;
    case Cmp::ICMP_NE:
      return Predicate::ne;
    case Cmp::ICMP_SLT:
      return Predicate::slt;
    case Cmp::ICMP_SLE:
      return Predicate::sle;
    case Cmp::ICMP_SGT:
      return Predicate::sgt;
    case Cmp::ICMP_SGE:
      return Predicate::sge;
    default:
      throw LiftError("a comparison that is always true or false");
  }
}

void refuse_fast_math(const llvm::Instruction& instruction) {
  const auto* number = llvm::dyn_cast<llvm::FPMathOperator>(&instruction);
  if (number != nullptr &&
      (number->hasAllowReassoc() || number->hasNoNaNs() || number->hasNoInfs() ||
       number->hasAllowReciprocal() || number->hasApproxFunc() || number->hasNoSignedZeros())) {
    throw LiftError(
        "an operation under -ffast-math, which may be computed in another order; allowed: the file "
        "compiled without it");
  }
}

}  // namespace veritrack::lift
