#ifndef EP_DEMOLISHER_H
#define EP_DEMOLISHER_H

#include <memory>

#include "Autopilot.h"
#include "Bridge.h"
#include "Vehicle.h"

namespace ep
{
/// The paper's third example (section 3.3): a heavy vehicle drives across a bridge of concrete blocks and steel joints.
struct DemolisherSettings
{
	Solver solver = Solver::Direct;
	int substeps = 4;          ///< of each step; with one, a tenth less flows
	int iterations = 50;       ///< in each substep, of what is solved iteratively
	btScalar gravity = 10;     ///< [m/s^2]
	btScalar gravityTime = 2;  ///< over which gravity grows: at once it would hit the bridge like a fall [s]
	btScalar start = -60;      ///< where the vehicle waits, x [m]
	BridgeSettings bridge;
	VehicleSettings vehicle;
	Autopilot::Settings autopilot;
};

/// How the joints are, and where the vehicle is.
struct DemolisherSummary
{
	int joints = 0;
	int yielded = 0;
	int broken = 0;
	double plasticEnergy = 0;                ///< [J]
	double sag = 0;                          ///< of the bridge's middle [m]
	btVector3 vehicle = btVector3(0, 0, 0);  ///< position of its centre [m]
	double speed = 0;                        ///< forward [m/s]
	bool crossed = false;                    ///< the vehicle stands on the far side's ground
	double time = 0;                         ///< simulated [s]
	double realTimeFactor = 0;               ///< simulated time over time spent on it, drawing excluded
};

class Demolisher
{
public:
	static constexpr btScalar STEP = btScalar(1) / 60;  ///< [s]

	explicit Demolisher(const DemolisherSettings& settings);

	/// One step.
	void step(const Controls& controls);

	/// One step, driven by the autopilot, which waits until gravity is there and the bridge is at rest.
	void stepByAutopilot();

	bool hasArrived() const;
	DemolisherSummary summary() const;

	const DemolisherSettings& settings() const { return m_settings; }
	World& world() { return m_world; }
	const Bridge& bridge() const { return m_bridge; }
	const Vehicle& vehicle() const { return m_vehicle; }

private:
	DemolisherSettings m_settings;
	World m_world;
	Bridge m_bridge;
	Vehicle m_vehicle;
	Autopilot m_autopilot;
	int m_steps = 0;
	double m_wallTime = 0;
};
}  // namespace ep

#endif  // EP_DEMOLISHER_H
