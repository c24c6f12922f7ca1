// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CONSTRAINT_H
#define BT_ELASTIC_PLASTIC_CONSTRAINT_H

#include "btElasticPlasticJoint.h"

/// One of Bullet's 6-dof constraints with the elastic-plastic joint added: first Base's own rows, then the elastic-plastic ones.
/// A degree of freedom belongs to one of the two. Base is not asked for rows if it has none.
template <class Base>
class btElasticPlasticConstraint : public Base, public btElasticPlasticJoint
{
public:
	/// Bullet looks at the first cache line of all joints again and again to find islands, and joints are mostly made one after
	/// another. Beginning on a line, and an odd number of lines apart, they spread over all sets of a cache; a multiple of four
	/// would leave three quarters of it unused (a third of the step of 500 chains of 20).
	static void* operator new(size_t size)
	{
		const size_t line = 64, bookkeeping = 80;  // of btAlignedAlloc and malloc
		return btAlignedAlloc(((size + bookkeeping + line - 1) / line | 1) * line - bookkeeping, line);
	}
	static void operator delete(void* memory) { btAlignedFree(memory); }
	static void* operator new(size_t, void* place) { return place; }
	static void operator delete(void*, void*) {}

	void buildJacobian() override
	{
		buildElasticPlastic();
		Base::buildJacobian();
	}

	void getInfo1(btTypedConstraint::btConstraintInfo1* info) override
	{
		info->m_numConstraintRows = info->nub = 0;
		const int rows = countElasticPlasticRows();
		if (hasBaseRows())
			Base::getInfo1(info);
		m_baseRows = info->m_numConstraintRows;
		info->m_numConstraintRows += rows;
	}

	void getInfo2(btTypedConstraint::btConstraintInfo2* info) override
	{
		if (m_baseRows > 0)
			Base::getInfo2(info);
		writeElasticPlasticRows(info, m_baseRows);
	}

	/// As a constraint of Base's, with what btElasticPlasticImport() needs beside it.
	const char* serialize(void* data, btSerializer* serializer) const override
	{
		const char* const type = Base::serialize(data, serializer);
		if (isInFile())
		{
			lock(data);
			serializeElasticPlastic(*serializer);
		}
		return type;
	}

	void solveConstraintObsolete(btSolverBody& bodyA, btSolverBody&, btScalar) override { answer(bodyA); }

protected:
	void updateDrawnFrames() override { Base::calculateTransforms(); }

	/// Calls lockInFile() with the data of Base.
	virtual void lock(void* data) const = 0;

	template <class... Arguments>
	explicit btElasticPlasticConstraint(Arguments&&... arguments)
		: Base(arguments...), btElasticPlasticJoint(*static_cast<Base*>(this), Base::m_frameInA, Base::m_frameInB)
	{
	}

private:
	int m_baseRows = 0;
};

#endif  // BT_ELASTIC_PLASTIC_CONSTRAINT_H
