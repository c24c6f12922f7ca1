// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "runs/RouteFile.h"

#include <algorithm>
#include <stdexcept>

#include "json/JsonFile.h"

namespace ep
{
namespace
{
[[noreturn]] void refuse(const std::string& what) { throw std::runtime_error(what); }

void checkKeys(const nlohmann::json& object, const std::vector<std::string>& known, const std::string& where)
{
	std::string all;
	for (const std::string& key : known)
		all += (all.empty() ? "" : ", ") + key;
	if (!object.is_object())
		refuse(where + " is " + shown(object) + "; it must be an object with the keys " + all);
	for (const auto& item : object.items())
		if (std::find(known.begin(), known.end(), item.key()) == known.end())
			refuse(where + " has the unknown key " + shown(item.key()) + "; known are " + all);
}

btScalar number(const nlohmann::json& leg, const char* key, double otherwise, double low, double high,
				const std::string& where)
{
	if (!leg.contains(key))
		return btScalar(otherwise);
	const nlohmann::json& value = leg.at(key);
	if (!value.is_number() || !(value.get<double>() >= low && value.get<double>() <= high))
		refuse(where + ": " + key + " is " + shown(value) + "; it must be a number from " + nlohmann::json(low).dump() +
			   " to " + nlohmann::json(high).dump());
	return btScalar(value.get<double>());
}

Leg toLeg(const nlohmann::json& json, const std::string& where)
{
	checkKeys(json, {"to_x_m", "speed_m_s", "stop", "wait_s"}, where);
	Leg leg;
	leg.drives = json.contains("to_x_m");
	if (!leg.drives && !json.contains("wait_s"))
		refuse(where + " needs to_x_m to drive, or wait_s to wait");
	leg.to.setX(number(json, "to_x_m", 0, -5000, 5000, where));
	leg.speed = number(json, "speed_m_s", double(leg.speed), .5, 26, where);
	leg.wait = number(json, "wait_s", 0, 0, 3600, where);
	if (json.contains("stop"))
	{
		if (!json.at("stop").is_boolean())
			refuse(where + ": stop is " + shown(json.at("stop")) + "; it must be true or false");
		leg.stops = json.at("stop").get<bool>();
	}
	return leg;
}
}  // namespace

Route readRoute(const std::string& file)
{
	const std::string where = "the autopilot's file '" + file + "' (--autopilot)";
	nlohmann::json json;
	try
	{
		json = readJson(file);
	}
	catch (const std::exception& error)
	{
		refuse(where + ": " + error.what());
	}
	checkKeys(json, {"legs"}, where);
	if (!json.contains("legs") || !json.at("legs").is_array() || json.at("legs").empty())
		refuse(where + " must have the key legs, a list of at least one, such as [{\"to_x_m\": 60}]");
	Route route;
	for (const nlohmann::json& leg : json.at("legs"))
		route.push_back(toLeg(leg, where + ", leg " + std::to_string(route.size() + 1)));
	return route;
}
}  // namespace ep
