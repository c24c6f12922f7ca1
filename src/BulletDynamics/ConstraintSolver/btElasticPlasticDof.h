// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_DOF_H
#define BT_ELASTIC_PLASTIC_DOF_H

/// Names of the six degrees of freedom in the joint's own frame; x runs along the member.
enum btElasticPlasticDof
{
	BT_EP_AXIAL,      ///< translation along x
	BT_EP_SHEAR_Y,    ///< translation along y, the direction of the section's height
	BT_EP_SHEAR_Z,    ///< translation along z, the direction of the section's width
	BT_EP_TORSION,    ///< rotation about x
	BT_EP_BENDING_Y,  ///< rotation about y: bends in the direction of the width
	BT_EP_BENDING_Z,  ///< rotation about z: bends in the direction of the height
	BT_EP_DOF_COUNT
};

inline bool btElasticPlasticIsDof(int dof) { return dof >= 0 && dof < BT_EP_DOF_COUNT; }

/// "axial", "shear y", ... "bending z"; "?" outside of 0 to 5.
const char* btElasticPlasticDofName(int dof);

#endif  // BT_ELASTIC_PLASTIC_DOF_H
