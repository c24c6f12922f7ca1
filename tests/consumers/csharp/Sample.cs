// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The box on a steel rod of the C sample, from C#: how an engine in a managed language calls the library.
using System;
using System.Runtime.InteropServices;

static class Btep
{
	const string Library = "BulletElasticPlastic";

	[StructLayout(LayoutKind.Sequential)]
	public struct Body
	{
		public UIntPtr size;
		public int shape;
		[MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] extent;
		public double mass;
		[MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] position;
		[MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)] public double[] rotation;
		public double friction;
	}

	[StructLayout(LayoutKind.Sequential)]
	public struct Material
	{
		public UIntPtr size;
		public double youngsModulus, poissonsRatio, yieldStress, ultimatePlasticStrain, dampingRatio, tensileShare, crushingStrain, shearModulus, shearStrength, friction;
	}

	[StructLayout(LayoutKind.Sequential)]
	public struct Capacity
	{
		public UIntPtr size;
		[MarshalAs(UnmanagedType.ByValArray, SizeConst = 6)] public double[] stiffness;
		[MarshalAs(UnmanagedType.ByValArray, SizeConst = 6)] public double[] yield;
		[MarshalAs(UnmanagedType.ByValArray, SizeConst = 6)] public double[] ductility;
		[MarshalAs(UnmanagedType.ByValArray, SizeConst = 2)] public double[] coupling;
		public double length, damping;
		public int fibres;
		public double friction;
	}

	[StructLayout(LayoutKind.Sequential)]
	public struct Event
	{
		public UIntPtr size;
		public int type, joint, dof;
		public double time, energy;
		[MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] position;
		[MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] impulse;
		[MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] velocity;
		public int fibre, part;
	}

	[DllImport(Library)] public static extern int btep_world_create(int version, double[] gravity, out IntPtr world);
	[DllImport(Library)] public static extern void btep_world_destroy(IntPtr world);
	[DllImport(Library)] public static extern int btep_world_step(IntPtr world, double length);
	[DllImport(Library)] public static extern IntPtr btep_world_message(IntPtr world);
	[DllImport(Library)] public static extern int btep_body_create(IntPtr world, ref Body description, out int body);
	[DllImport(Library)]
	public static extern int btep_capacity_of_member(IntPtr world, ref Material material, double width, double height, double lengthA,
													 double lengthB, ref Capacity capacity);
	[DllImport(Library)]
	public static extern int btep_joint_create(IntPtr world, int a, int b, double[] position, double[] rotation, ref Capacity capacity,
											   out int joint);
	[DllImport(Library)] public static extern int btep_event_next(IntPtr world, ref Event happened);
}

static class Sample
{
	static IntPtr world;

	static void Check(int result)
	{
		if (result < 0)
			throw new Exception(result + ": " + Marshal.PtrToStringAnsi(Btep.btep_world_message(world)));
	}

	static UIntPtr SizeOf<T>() { return (UIntPtr)(uint)Marshal.SizeOf(typeof(T)); }

	static int AddBox(double mass, double height)
	{
		var box = new Btep.Body { size = SizeOf<Btep.Body>(), shape = 0, extent = new double[] { 1, 1, 1 }, mass = mass,
								  position = new double[] { 0, height, 0 }, rotation = new double[] { 0, 0, 0, 1 }, friction = 0.5 };
		int body;
		Check(Btep.btep_body_create(world, ref box, out body));
		return body;
	}

	static int Main()
	{
		Check(Btep.btep_world_create(3, new double[] { 0, -10, 0 }, out world));
		int support = AddBox(0, 0), load = AddBox(3000, -2), joint;
		var steel = new Btep.Material { size = SizeOf<Btep.Material>(), youngsModulus = 200e9, poissonsRatio = 0.3,
										yieldStress = 200e6, ultimatePlasticStrain = 0.2, dampingRatio = 0.01,
										tensileShare = 1 };
		var rod = new Btep.Capacity { size = SizeOf<Btep.Capacity>() };
		Check(Btep.btep_capacity_of_member(world, ref steel, 0.01, 0.01, 1, 1, ref rod));
		double half = Math.Sqrt(0.5);
		Check(Btep.btep_joint_create(world, support, load, new double[] { 0, -1, 0 }, new double[] { 0, 0, -half, half }, ref rod,
									 out joint));
		bool isBroken = false;
		for (int i = 0; i < 240 && !isBroken; ++i)
		{
			Check(Btep.btep_world_step(world, 1.0 / 240));
			var happened = new Btep.Event { size = SizeOf<Btep.Event>() };
			while (Btep.btep_event_next(world, ref happened) == 0)
			{
				Console.WriteLine("{0:F3} s: event {1} of joint {2}, {3:F0} J", happened.time, happened.type, happened.joint,
								  happened.energy);
				isBroken |= happened.type == 1 && happened.joint == joint;
			}
		}
		Btep.btep_world_destroy(world);
		return isBroken ? 0 : 1;
	}
}
