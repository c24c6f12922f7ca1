#include "BulletDynamics/ConstraintSolver/btElasticPlasticMaterial.h"

int main()
{
	return 0;
}
