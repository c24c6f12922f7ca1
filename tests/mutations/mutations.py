# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""Defects that a test has to notice: what is in a file, what comes in its place, and the tests that are nearest."""

from collections import namedtuple

Mutation = namedtuple("Mutation", "name file old new tests")

MUTATIONS = [
    # ---- sections and capacities
    Mutation("flanges' shear area", "btElasticPlasticSection.cpp", "btScalar(2 * b * tf * 5 / 6)",
             "btScalar(1.03 * 2 * b * tf * 5 / 6)", "*Section*:*Member*"),
    Mutation("rectangle's plastic modulus", "btElasticPlasticSection.cpp", "s.m_plasticModulus[1] = btScalar(b * h * h / 4)",
             "s.m_plasticModulus[1] = btScalar(b * h * h / 4.04)", "*Section*"),
    Mutation("torsion constant's series", "btElasticPlasticSection.cpp", "n <= 15; n += 2", "n <= 1; n += 2", "*Section*"),
    Mutation("tube's shear coefficient", "btElasticPlasticSection.cpp", "6 * n / (7 * n + 20 * m2)",
             "6 * n / (7 * n + 18 * m2)", "*Section*"),
    Mutation("bending in the stiffness of shear", "btElasticPlasticCapacity.cpp", "(3 * E * section.m_secondMoment[1 - i]",
             "(3.1 * E * section.m_secondMoment[1 - i]", "*Member*:*Capacity*:*Frames*"),
    Mutation("sign of the coupling", "btElasticPlasticCapacity.cpp", "(i == 0 ? -middle : middle)",
             "(i == 0 ? middle : -middle)", "*Frames*:*Member*"),
    Mutation("work of shear in ductility", "btElasticPlasticCapacity.cpp", ": fy / tau);", ": tau / fy);",
             "*Capacity*:*Ductility*"),
    # ---- kinematics
    Mutation("arms meet off the middle", "Kinematics.cpp", "m_rB = armB.rounded() - d * btScalar(0.5)",
             "m_rB = armB.rounded() - d * btScalar(0.45)", "*Kinematics*:*JointStep*"),
    Mutation("bow shortens less", "Kinematics.h", "lengthZ * z * z) / 12", "lengthZ * z * z) / 13", "*Kinematics*:*Stability*"),
    Mutation("flow of fibres stretches the axial spring", "JointStep.cpp", "state.m_initial[BT_EP_AXIAL] += longer;", "state.m_initial[BT_EP_AXIAL] += 0 * longer;", "Fibres.*"),
    Mutation("logarithm's series", "Kinematics.cpp", "btScalar(1. / 6)", "btScalar(1. / 5)", "*Kinematics*:*Hinge*"),
    Mutation("half of a turn", "Kinematics.cpp", "const btScalar s = btSin(angle / 2) / angle",
             "const btScalar s = btSin(angle / 2) / (angle * btScalar(1.001))", "*Kinematics*:*Hinge*"),
    Mutation("plastic middle turns by the whole", "JointModel.cpp", "exponential(elastic * btScalar(-0.5))",
             "exponential(elastic * btScalar(-1))", "*Hinge*:*HardJoints*"),
    # ---- law
    Mutation("damping by the row", "Law.h", "{ return a / (a + 4); }", "{ return a / (a + 8); }", "*Law*:*Accuracy*"),
    Mutation("no damping of a changed step", "Law.h", "btFabs(dt - lastStep) / (dt + lastStep)", "btScalar(0)",
             "*Law*:*StepControl*:*Energy*"),
    Mutation("bound of the mean force", "Law.h", "row.m_upper = dt * (c + m_alpha * s.m_yield)",
             "row.m_upper = dt * (c + btScalar(0.99) * m_alpha * s.m_yield)", "*Law*:*Block*"),
    Mutation("rate in what is known", "Law.h", "m_beta * dt * s.m_forceRate", "btScalar(0.9) * m_beta * dt * s.m_forceRate",
             "*Law*:*Accuracy*"),
    Mutation("rigid row without error reduction", "Law.h", "row.m_velocity = erp * strain / dt", "row.m_velocity = 0 * erp * strain / dt",
             "*Readings*"),
    Mutation("stock row's compliance", "Law.h", "btScalar(0.5) * diagonal)", "btScalar(0.9) * diagonal)", "*Law*"),
    Mutation("coupled rows' target", "Law.h", "rows[i].m_velocity += coupling *", "rows[i].m_velocity += btScalar(0.95) * coupling *",
             "*Law*:*Frames*:*CoupledPair*"),
    # ---- return mapping
    Mutation("flow where the impulse is free", "Law.h", "const bool flows = side != 0 && outcome.isAtBound(side, s.m_yield * dt)",
             "const bool flows = side != 0", "*Law*:*JointStep*:*Solvers*"),
    Mutation("coupled increment", "Law.h", "- coupling * mapped[1 - i].m_force", "- 0 * coupling * mapped[1 - i].m_force",
             "*Law*:*CoupledPair*:*Frames*"),
    Mutation("rigid flow", "Law.h", "r.m_increment = atBound ? strain : btScalar(0)", "r.m_increment = atBound ? strain / 2 : btScalar(0)",
             "*Constraint*:*Readings*"),
    Mutation("which of two bounds", "CoupledPair.h", "pressing * Real(beyond[i]) >= 0", "pressing * Real(beyond[i]) <= 0", "*CoupledPair*"),
    # ---- energies, damage, readings
    Mutation("elastic energy of torsion", "JointModel.cpp", "energy += 0.5 * double(m_state.m_force[i]) * double(elasticDeformation(i))",
             "energy += (i == 3 ? 0.25 : 0.5) * double(m_state.m_force[i]) * double(elasticDeformation(i))", "*Energy*:*Readings*"),
    Mutation("damage without shear z", "JointStep.cpp", "damage += btFabs(mapped[r].m_increment) / m_model.m_capacity.m_ductility[m_row[r].m_dof]",
             "damage += m_row[r].m_dof == 2 ? 0 : btFabs(mapped[r].m_increment) / m_model.m_capacity.m_ductility[m_row[r].m_dof]",
             "Ductility.*:*Damage*:*Break*:*Readings*"),
    Mutation("plastic energy", "JointStep.cpp", "state.m_plasticEnergy += force * fabs(double(increment[i]))",
             "state.m_plasticEnergy += 0.99 * force * fabs(double(increment[i]))", "*Energy*"),
    Mutation("work by the last velocity", "JointStep.cpp", "(double(m_row[r].m_velocity0) + double(velocity1[m_row[r].m_dof]))",
             "(2 * double(velocity1[m_row[r].m_dof]))", "*Energy*"),
    Mutation("feedback without B's arm", "JointWorks.cpp", "(torque + k.m_rB.cross(force)) * B.getAngularFactor()",
             "torque * B.getAngularFactor()", "*Readings*:*Feedback*"),
    Mutation("damping's loss", "MaterialDamping.h", "return m_dt / (m_branch[i].m_gain * m_branch[i].m_time)",
             "return btScalar(0.9) * m_dt / (m_branch[i].m_gain * m_branch[i].m_time)", "*Damping*"),
    Mutation("a branch's weight", "MaterialDamping.h", "btScalar(1.23)", "btScalar(1.5)", "*Damping*"),
    Mutation("joints give without end", "EnergyLedger.cpp", "if (given > most && given < MOST)", "if (given > 2 * most + 1 && given < MOST)",
             "*EnergyLedger*:*Taut*"),
    # ---- taut joints
    Mutation("tension's leverage", "TensionDamping.cpp", "const btScalar stiffness = tension * leverage / length",
             "const btScalar stiffness = tension * leverage / length / 8", "*Taut*"),
    # ---- solver
    Mutation("moment of an arm in H", "SystemMatrix.cpp", "add(left[3 + r], m_mixed ? bottom[mirrored] + m_mixed[mirrored] : bottom[mirrored])",
             "add(left[3 + r], 1.01 * (m_mixed ? bottom[mirrored] + m_mixed[mirrored] : bottom[mirrored]))", "*System*:*Accuracy*:*Destruction*"),
    Mutation("no line search", "System.cpp", "t = next > low && next < high ? next : (low + high) / 2", "t = 1", "*System*:*Destruction*"),
    Mutation("coupling in psi", "AdmissibleBox.h", "strain += 0.5 * row.m_coupling", "strain += 0.4 * row.m_coupling",
             "*AdmissibleBox*"),
    Mutation("fibres turn the wrong way", "Jacobian.cpp", "aboutZ -= fibre.m_y * impulses[i]", "aboutZ += fibre.m_y * impulses[i]", "*Fibre*"),
    Mutation("contact's multiplier", "AugmentedContacts.cpp", "state.m_slip = rest;\n\t\trow.m_target = state.m_target + state",
             "state.m_slip = rest;\n\t\trow.m_target = state.m_target + 0.9 * state", "*Contacts*"),
    # ---- step control
    Mutation("motion as a whole counts", "OpenShare.cpp", "carried += 0.5 * m_momentum[k]", "carried += 0.4 * m_momentum[k]",
             "*OpenShare*"),
    Mutation("open work", "OpenShare.cpp", "m_openWork += yield * length * change", "m_openWork += yield * length * change / 4",
             "*StepControl*:*OpenShare*:*InnerSteps*"),
    Mutation("a stop's steps one by one", "OpenShare.cpp", "MOST_STEPS_TO_REST = 25", "MOST_STEPS_TO_REST = 2", "InnerSteps.LetA*"),
    Mutation("bending is damped as the axial spring", "FibreStep.cpp", "if (motion.m_isInner && !m_model.anyBearsPressureOnly())", "if (false)", "InnerSteps.BendWhat*"),
    Mutation("what opens is damped as bending", "FibreStep.cpp", "if (motion.m_isInner && !m_model.anyBearsPressureOnly())", "if (motion.m_isInner)",
             "Energy.OfFibres*"),
    Mutation("a torn crack is a wedge", "FibreStep.cpp", "state.m_offset -= btScalar(stretch);", "", "Softening.Closes*"),
    Mutation("a crack forgets what it has been crushed by", "FibreStep.cpp", "btScalar(state.m_isCracked ? crushed : 1)", "btScalar(state.m_isCracked ? 0 : 1)", "Softening.*"),
    Mutation("coarser too soon", "btElasticPlasticStepControl.cpp", "m_calm >= CALM_STEPS * m_dt", "m_calm >= 0 * CALM_STEPS * m_dt",
             "*StepControl*"),
]
