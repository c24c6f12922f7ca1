// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FIELDS_H
#define EP_FIELDS_H

#include <functional>
#include <string>
#include <vector>

#include "LinearMath/btVector3.h"
#include "text/Named.h"

namespace ep
{
/// Of a number: what is allowed, both ends included.
struct Range
{
	double low, high;
	bool isAbove = false;  ///< low itself is not allowed

	static Range any() { return {-1e30, 1e30}; }
	static Range above(double low) { return {low, 1e30, true}; }
	static Range notNegative() { return {0, 1e30}; }
	static Range place() { return {-1e6, 1e6}; }  ///< coordinates [m]
};

/// What a key is to its object.
enum class Need
{
	Optional,
	Required
};

/// The keys of an object of a scene's file. A record has one function that names them all,
///
///     void fields(Fields& f, Ball& ball)
///     {
///         f.number("radius", ball.radius, Range::above(0), "m", "of the ball", Need::Required);
///     }
///
/// which reads a file where f is a FieldReader, and describes it where f is a FieldSchema: what is read is what is
/// documented. Each function tells whether the file has the key; a description never has. A value that is not allowed stays as it was.
class Fields
{
public:
	virtual ~Fields() = default;

	/// \param unit  empty: none
	virtual bool number(const char* key, double& value, const Range& range, const char* unit, const char* help,
						Need need = Need::Optional) = 0;
	virtual bool whole(const char* key, int& value, int low, int high, const char* help,
					   Need need = Need::Optional) = 0;
	virtual bool flag(const char* key, bool& value, const char* help) = 0;

	/// Up to 200 characters.
	virtual bool text(const char* key, std::string& value, const char* help, Need need = Need::Optional) = 0;

	/// The name of a file. A relative one is under the folder of the file that it stands in.
	virtual bool file(const char* key, std::string& name, const char* help) = 0;

	/// One of some names. \param index  of the chosen one
	virtual bool choice(const char* key, size_t& index, const std::vector<std::string>& names, const char* help) = 0;

	/// Numbers of one range.
	virtual bool numbers(const char* key, std::vector<double>& values, size_t least, size_t most, const Range& range,
						 const char* unit, const char* help, Need need = Need::Optional) = 0;

	using ReadFields = std::function<void(Fields&)>;
	using ReadNamed = std::function<void(const std::string& name, Fields&)>;

	virtual bool object(const char* key, const char* help, const ReadFields& read) = 0;

	/// A list of objects. A description calls read once.
	virtual bool list(const char* key, size_t most, const char* help, const ReadFields& read) = 0;

	/// An object whose keys are names of objects. A description calls read once.
	virtual bool named(const char* key, const char* help, const ReadNamed& read) = 0;

	/// A name out of those that are known, or the object itself. \param type  of the object, such as material
	virtual bool reference(const char* key, const char* type, const std::vector<std::string>& known,
						   const std::function<void(const std::string&)>& take, const char* help,
						   const ReadFields& read, Need need = Need::Optional) = 0;

	/// A key that has been read before: the description has a type of its name.
	virtual void known(const char* key) = 0;

	/// Of these keys exactly one must be there.
	virtual void oneOf(const std::vector<std::string>& keys) = 0;

	/// Tells that a key's value, or with an empty key the object, is not allowed for another reason: "is ..., it must be ...".
	virtual void refuse(const std::string& key, const std::string& what) = 0;

	/// Complaints are to be told of, and nothing is to be built of what was read.
	virtual bool hasFailed() const = 0;

	// ---- of the above

	bool vector(const char* key, btVector3& value, const char* unit, const char* help, Need need = Need::Optional,
				const Range& range = Range::place())
	{
		std::vector<double> all = {double(value.x()), double(value.y()), double(value.z())};
		const bool isThere = numbers(key, all, 3, 3, range, unit, help, need);
		value.setValue(btScalar(all[0]), btScalar(all[1]), btScalar(all[2]));
		return isThere;
	}

	/// A direction: a vector of any length but 0, brought to 1.
	bool direction(const char* key, btVector3& value, const char* help)
	{
		btVector3 given = value;
		const bool isThere = vector(key, given, "", help);
		if (isThere && given.length() > btScalar(1e-6))
			value = given.normalized();
		else if (isThere)
			refuse(key, "has no length; it must be a direction, such as [1, 0, 0]");
		return isThere;
	}

	/// Of a library's struct.
	bool scalar(const char* key, btScalar& value, const Range& range, const char* unit, const char* help)
	{
		double number = double(value);
		const bool isThere = this->number(key, number, range, unit, help);
		value = btScalar(number);
		return isThere;
	}

	template <class Value>
	bool named(const char* key, Value& value, const std::vector<Named<Value>>& choices, const char* help)
	{
		size_t index = 0;
		while (index + 1 < choices.size() && !(choices[index].value == value))
			++index;
		const bool isThere = choice(key, index, namesOf(choices), help);
		value = choices[index].value;
		return isThere;
	}
};
}  // namespace ep

#endif  // EP_FIELDS_H
